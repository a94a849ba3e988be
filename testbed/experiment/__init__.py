"""Experiments: a configuration becomes trials, trials become records, records become a report."""

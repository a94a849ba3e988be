"""Descriptions as answer set programs: the literal translation, and the compact one."""

from asp.translation.compact import NotCompactError, compact
from asp.translation.literal import translate, translate_source
from asp.translation.rules import ACTION, Part, Rule, condition, rule, schema, sort_conditions

__all__ = [
    "ACTION",
    "NotCompactError",
    "Part",
    "Rule",
    "compact",
    "condition",
    "rule",
    "schema",
    "sort_conditions",
    "translate",
    "translate_source",
]

"""Descriptions as answer set programs: the literal translation, and the compact one."""

from asp.translation.compact import NotCompactError, compact
from asp.translation.literal import translate, translate_source
from asp.translation.rules import (
    ACTION,
    BASE,
    OPEN,
    STATE,
    STEP,
    Rule,
    condition,
    confined,
    plain,
    rule,
    schema,
    sort_conditions,
    term_text,
)

__all__ = [
    "ACTION",
    "BASE",
    "OPEN",
    "STATE",
    "STEP",
    "NotCompactError",
    "Rule",
    "compact",
    "condition",
    "confined",
    "plain",
    "rule",
    "schema",
    "sort_conditions",
    "term_text",
    "translate",
    "translate_source",
]

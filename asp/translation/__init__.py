"""Descriptions as answer set programs: the literal translation, and the compact one."""

from asp.translation.compact import NotCompactError as NotCompactError
from asp.translation.compact import compact as compact
from asp.translation.literal import translate as translate
from asp.translation.literal import translate_source as translate_source
from asp.translation.rules import ACTION as ACTION
from asp.translation.rules import Part as Part
from asp.translation.rules import Rule as Rule
from asp.translation.rules import condition as condition
from asp.translation.rules import rule as rule
from asp.translation.rules import schema as schema
from asp.translation.rules import sort_conditions as sort_conditions

"""The action language AL_d: text in, a checked and ground description out."""

from asp.language.checker import check, check_cycles, reachable
from asp.language.description import (
    Causal,
    Constraint,
    Default,
    Description,
    Executability,
    Literals,
    Sees,
    Shows,
    Trigger,
)
from asp.language.errors import Problems, SourceError, suggestion
from asp.language.functions import Function, excluding_place, functions, schematic, subject
from asp.language.grounding import closed_world, ground_description, pattern_of, static_truth
from asp.language.literals import Action, Fluent, Literal
from asp.language.loading import (
    MOST_TEXTS,
    analyse,
    check_one_robot,
    load_description,
    packaged_domains,
    parse_description,
    read_domain,
    read_packaged,
)
from asp.language.matching import NOTHING, Facts, Pattern, Row, Truth
from asp.language.parser import ToSyntax, grammar, parse, parse_with, scenario_notes
from asp.language.restriction import named, narrowed, restrict, without_exogenous
from asp.language.signature import Signature, signature_of
from asp.language.variable_sorts import variable_domains
from asp.language.writer import text_of

__all__ = [
    "MOST_TEXTS",
    "NOTHING",
    "Action",
    "Causal",
    "Constraint",
    "Default",
    "Description",
    "Executability",
    "Facts",
    "Fluent",
    "Function",
    "Literal",
    "Literals",
    "Pattern",
    "Problems",
    "Row",
    "Sees",
    "Shows",
    "Signature",
    "SourceError",
    "ToSyntax",
    "Trigger",
    "Truth",
    "analyse",
    "check",
    "check_cycles",
    "check_one_robot",
    "closed_world",
    "excluding_place",
    "functions",
    "grammar",
    "ground_description",
    "load_description",
    "named",
    "narrowed",
    "packaged_domains",
    "parse",
    "parse_description",
    "parse_with",
    "pattern_of",
    "reachable",
    "read_domain",
    "read_packaged",
    "restrict",
    "scenario_notes",
    "schematic",
    "signature_of",
    "static_truth",
    "subject",
    "suggestion",
    "text_of",
    "variable_domains",
    "without_exogenous",
]

"""Which tests exercise a theory, those first that take least."""

from collections.abc import Mapping

_LIVES = "tests/agents/intentional/test_incremental.py"
_PREFERENCES = "tests/agents/intentional/test_preferences.py"
_REPORTS = "tests/agents/intentional/test_reports.py"
_AXIOMS = "tests/asp/theories/test_axioms.py"
_EXPLANATIONS = "tests/asp/reasoning/diagnosis/test_explanations.py"
_COMPRESSION = "tests/asp/reasoning/diagnosis/test_history_compression.py"
_GOES_ON = "test_it_goes_on_where_some_smallest_explanation_lets_it"
_JOINT = "tests/agents/intentional/test_joint.py"
_JOINT_LIVES = "tests/agents/intentional/test_joint_lives.py"
_PLANS = "tests/asp/reasoning/planning/test_plans.py"
_PLANS_KEPT = "tests/asp/reasoning/planning/test_incremental_plans.py"
_COMPRESSED = f"{_COMPRESSION}::test_a_long_history_is_explained_by_what_is_compressed"
_OUTCOMES = "tests/asp/theories/test_outcomes.py"
_REASONS = "tests/agents/intentional/test_reasons.py"

EXERCISED: Mapping[str, tuple[str, ...]] = {
    "awareness": ("tests/asp/translation/test_translation.py",),
    "belief": (
        "tests/agents/traditional/test_told.py",
        "tests/agents/traditional/test_incremental.py",
    ),
    "conflict": (
        "tests/agents/intentional/test_inconsistent.py",
        "tests/agents/intentional/test_inconsistent_lives.py",
    ),
    "defaults": (_AXIOMS, _PREFERENCES),
    "diagnosis": (_EXPLANATIONS, _PREFERENCES, _REPORTS),
    "fine_inference": ("tests/asp/reasoning/fine_knowledge/test_fine_knowledge.py",),
    "fine_planning": (
        "tests/asp/reasoning/fine_planning/test_fine_planning.py",
        "tests/asp/reasoning/fine_planning/test_fine_plans.py",
    ),
    "goal_persistence": ("tests/agents/intentional/test_persistence.py",),
    "history": (_AXIOMS, _REPORTS),
    "incremental_diagnosis": (
        "tests/asp/reasoning/test_successors.py",
        _REPORTS,
        _COMPRESSED,
        _PREFERENCES,
        _COMPRESSION,
        _LIVES,
    ),
    "incremental_fine_planning": (
        "tests/asp/reasoning/fine_planning/test_incremental_fine_plans.py",
        "tests/asp/reasoning/fine_planning/test_problem_program.py",
    ),
    "incremental_planning": (_PLANS_KEPT, _LIVES),
    "incremental_transitions": (
        "tests/asp/reasoning/test_successors.py",
        f"{_REASONS}::test_nor_where_some_fluents_are_defined",
    ),
    "intentions": (_REPORTS, _AXIOMS, "tests/agents/intentional/test_persistence.py"),
    "joint": (_JOINT, _JOINT_LIVES),
    "misreadings": ("tests/asp/reasoning/diagnosis/test_misreadings.py",),
    "order": (_EXPLANATIONS, "tests/asp/theories/test_order.py"),
    "planning": (_REPORTS, _OUTCOMES, _PREFERENCES, _PLANS, _LIVES),
    "qualifications": ("tests/asp/reasoning/test_qualifications.py",),
    "reach": (
        f"{_REASONS}::test_where_states_are_too_many_to_look_at_there_are_shorter_proofs",
        f"{_REASONS}::test_what_holds_by_definition_may_cease_to",
        f"{_REASONS}::test_out_of_reach_is_what_no_search_finds",
    ),
    "shortest_plan": ("tests/asp/reasoning/planning/test_reference_plans.py",),
    "transitions": ("tests/asp/translation/test_translation.py",),
    "undivided": (f"{_JOINT}::{_GOES_ON}", _JOINT_LIVES),
}
"""By the theory's name: paths of test files, or of single tests in them."""

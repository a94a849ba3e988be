"""What code cites can be looked up: every section is one of docs/references.md."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).parent.parent
SECTION = r"[DP] [1-9](?:\.[1-9])*"
LISTED = set(
    re.findall(
        rf"^\| ({SECTION}) \|", (ROOT / "docs/references.md").read_text("utf-8"), re.MULTILINE
    )
)
FILES = sorted(
    path
    for folder in ("asp", "agents", "testbed", "tests", "configs", "docs")
    for path in (ROOT / folder).rglob("*")
    if path.suffix in {".py", ".lp", ".al", ".lark", ".yaml", ".md"} and path != Path(__file__)
)


def test_sections_of_both_documents_are_listed() -> None:
    assert {section[0] for section in LISTED} == {"D", "P"}


@pytest.mark.parametrize("path", FILES, ids=lambda path: str(path.relative_to(ROOT)))
def test_every_section_cited_is_listed(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert set(re.findall(rf"\b{SECTION}\b", text)) <= LISTED
    assert re.findall(r"\bspec [0-9]", text, re.IGNORECASE) == []

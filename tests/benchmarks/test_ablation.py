"""Each part is left out once, and nothing that is answered changes."""

from benchmarks import ablation


def test_the_answers_are_the_same_without_each_part() -> None:
    (sheet,) = ablation.main("small")
    assert len(sheet.rows) == len(ablation.OFFICES["small"]) + len(ablation.EDGES["small"])
    for row in sheet.rows:
        assert all(isinstance(row[f"{part}_times"], float) for part in ablation.SWITCHES)

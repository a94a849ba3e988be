"""Translate an action description."""

from pathlib import Path
from typing import Annotated

import typer

from testbed.cli.common import emit, examples, input_errors

EPILOG = examples("testbed translate office -o office.lp", "testbed translate office.fine")


def command(
    source: Annotated[
        str,
        typer.Argument(
            metavar="FILE",
            help="A description (.al), the refinement of one (.fine), or a packaged domain's name.",
        ),
    ],
    output: Annotated[
        Path | None, typer.Option("-o", "--output", metavar="FILE.lp", help="Instead of printing.")
    ] = None,
) -> None:
    """Translate an action description from AL_d to answer set programming.

    Of a refinement it is the program of the refined description with its theory of observation.
    """
    from asp import translation
    from asp.language import read_domain
    from asp.refinement import load_refinement
    from testbed.experiment.run_folder import naming

    with input_errors():
        if source.endswith(".fine"):
            refinement = load_refinement(source)
            program = translation.translate_source(refinement.strong, refinement.strong_signature)
        else:
            program = translation.translate(*reversed(read_domain(source)))
        if output is None:
            emit(program)
        else:
            with naming(output):
                output.write_text(program, encoding="utf-8")

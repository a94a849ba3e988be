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

    Of a refinement it is the program of the refined description with its theory of observation. A
    description in which an action has several outcomes is translated with a warning.
    """
    from asp import translation
    from asp.language import parse_description, read_domain
    from asp.refinement import load_refinement
    from testbed.cli.branching import warn_of_branching
    from testbed.experiment.run_folder import naming

    with input_errors():
        if source.endswith(".fine"):
            refinement = load_refinement(source)
            program = translation.translate_source(refinement.strong, refinement.strong_signature)
            file, description = source, refinement.description
        else:
            file, text = read_domain(source)
            program = translation.translate(text, file)
            description = parse_description(text, file)
        if output is None:
            emit(program)
        else:
            with naming(output):
                output.write_text(program, encoding="utf-8")
        warn_of_branching(description, program, file)

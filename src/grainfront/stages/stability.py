"""The stability matrix, its table and its pictures."""

from __future__ import annotations

from grainfront.stages.stage import stage


@stage
def stability(*, record: str) -> None:
    """Run all cases and write what was found; nothing where a case is not as expected."""
    from grainfront.files.stability import write_stability
    from grainfront.studies.stability import measure_stability

    write_stability(record, measure_stability())


@stage
def stability_report(
    *, record: str, table: str, matrix_picture: str, clearance_picture: str
) -> None:
    """Write the table of a record and draw its pictures."""
    from grainfront import figures
    from grainfront.files.atomic import write_text
    from grainfront.files.stability import read_stability
    from grainfront.files.stability_table import markdown

    found = read_stability(record)
    write_text(table, markdown(found))
    figures.save_png(figures.stability(found), matrix_picture)
    figures.save_png(figures.clearance(found), clearance_picture)

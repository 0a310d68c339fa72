# Errors against the run time they cost; built by `snakemake error_vs_time` alone.


wildcard_constraints:
    axis="[a-z]+",


def error_vs_time_results(wildcards):
    """Records and pictures of all scenes that list axes; there must be one."""
    found = [scene for scene in SCENES.values() if scene.error_vs_time]
    if not found:
        sys.exit(
            "grainfront: config/config.yaml: none of the scenes "
            f"{', '.join(SCENES)} says error_vs_time, but one that lists its axes must be named."
        )
    for scene in found:
        folder = f"results/{scene.name}"
        yield f"{folder}/error_vs_time.nc"
        for axis in scene.error_vs_time.axes:
            yield f"{folder}/figures/error_vs_time_{axis}.png"


# The axes of all scenes that list some, and their pictures.
rule error_vs_time:
    input:
        error_vs_time_results,
    message:
        "errors against run time are there, below results/"


# All axes of a scene; takes all cores, so that nothing beside it disturbs the times.
rule error_vs_time_record:
    input:
        zone_files,
        database="results/{scene}/shapes.nc",
    output:
        record="results/{scene}/error_vs_time.nc",
    threads: workflow.cores
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene(
            "length_unit",
            "seeds",
            "domain",
            "shapes",
            "size",
            "matched",
            "orientation",
            "arrangement",
            "packing",
            "target",
            "error_vs_time",
            "replacement",
        ),
        sources=stages.sources_digest("error_vs_time"),
    message:
        "{wildcards.scene}: errors against run time"
    script:
        "../scripts/error_vs_time.py"


rule error_vs_time_picture:
    input:
        record="results/{scene}/error_vs_time.nc",
    output:
        picture=report(
            "results/{scene}/figures/error_vs_time_{axis}.png",
            caption="../report/error_vs_time.rst",
            category="{scene}",
            labels={"picture": "error against run time: {axis}"},
        ),
    params:
        sources=stages.sources_digest("error_vs_time_picture"),
    message:
        "{wildcards.scene}: picture of error against run time, {wildcards.axis}"
    script:
        "../scripts/error_vs_time_picture.py"

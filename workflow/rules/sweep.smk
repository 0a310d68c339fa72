# Packings at many efforts, in chunks, and the contour maps that they make.

from grainfront.studies import sweep as plan

# Packings of a sweep that run side by side in a job.
SWEEP_THREADS = 2


wildcard_constraints:
    chunk="[0-9]+",
    chunks="[0-9]+",


def sweep_depends_on(wildcards):
    """The fields of the scene that the numbers of its sweep depend on."""
    scene = SCENES[wildcards.scene]
    fields = [
        getattr(scene, name)
        for name in (
            "length_unit",
            "domain",
            "size",
            "matched",
            "orientation",
            "arrangement",
            "sweep",
            "replacement",
        )
    ]
    return repr([*fields, scene.packing.n_bin, scene.seeds[0]])


def sweep_kernels(wildcards):
    """The kernels of all searches that a sweep needs."""
    return [
        f"results/.{search}.compiled"
        for search in plan.searches(SCENES[wildcards.scene])
    ]


def sweep_chunks(wildcards):
    """The chunks of a sweep; none where it needs but one, which the contour map packs itself."""
    count = plan.chunk_count(
        SCENES[wildcards.scene], SWEEP_THREADS * CONFIG["chunk_seconds"]
    )
    numbers = range(1, count + 1) if count > 1 else []
    return [f"results/{wildcards.scene}/sweep/{number}of{count}" for number in numbers]


# One chunk. Each packing is kept in a file of its own beside the mark, which is no output, so that
# a killed run resumes after the packings that are finished.
rule sweep:
    input:
        zone_files,
        database="results/{scene}/shapes.nc",
        compiled=ancient(sweep_kernels),
    output:
        done=temp(touch("results/{scene}/sweep/{chunk}of{chunks}")),
    threads: SWEEP_THREADS
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        folder=lambda wildcards: f"results/{wildcards.scene}/sweep",
        depends_on=sweep_depends_on,
        sources=stages.sources_digest("sweep"),
    message:
        "{wildcards.scene}: chunk {wildcards.chunk} of {wildcards.chunks} of the sweep"
    script:
        "../scripts/sweep.py"


# The map; packs what no chunk has packed, and removes the packings' files when it is complete.
rule contour:
    input:
        sweep_chunks,
        zone_files,
        database="results/{scene}/shapes.nc",
        compiled=ancient(sweep_kernels),
    output:
        contour="results/{scene}/contour.nc",
        timing="results/{scene}/contour_timing.nc",
    threads: SWEEP_THREADS
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        folder=lambda wildcards: f"results/{wildcards.scene}/sweep",
        depends_on=sweep_depends_on,
        sources=stages.sources_digest("sweep"),
    message:
        "{wildcards.scene}: contour map"
    script:
        "../scripts/contour.py"


# Planned only for scenes with a sweep whose outputs name figures.
rule contour_picture:
    input:
        contour="results/{scene}/contour.nc",
    output:
        picture=pictures_of("contour"),
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene("target"),
        sources=stages.sources_digest("contour_picture"),
    message:
        "{wildcards.scene}: picture of the contour map"
    script:
        "../scripts/contour_picture.py"

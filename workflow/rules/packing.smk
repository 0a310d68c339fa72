# Hulls packed by the advancing front method.

TARGETED = [name for name, scene in SCENES.items() if scene.target]


def one_of(names):
    """A pattern for these names alone; one that fits nothing where there are none."""
    return "|".join(names) or "(?!)"


def kernels_of(wildcards):
    """The kernels of the searches that a scene needs."""
    searches = api.searches(SCENES[wildcards.scene])
    return [f"results/.{search}.compiled" for search in searches]


# One packing a seed; the run time has a file of its own, so that equal input gives equal bytes.
rule packing:
    input:
        zone_files,
        database="results/{scene}/shapes.nc",
        compiled=ancient(kernels_of),
    output:
        packing="results/{scene}/{seed}/packing.nc",
        timing="results/{scene}/{seed}/timing.json",
    wildcard_constraints:
        scene=one_of(name for name in SCENES if name not in TARGETED),
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene(
            "length_unit",
            "domain",
            "size",
            "matched",
            "orientation",
            "arrangement",
            "packing",
        ),
        sources=stages.sources_digest("packing"),
    message:
        "{wildcards.scene}: packing of seed {wildcards.seed}"
    script:
        "../scripts/packing.py"


def contour_of(wildcards):
    """The contour map of a scene that asks for one; it tells where to start."""
    swept = SCENES[wildcards.scene].sweep
    return {"contour": f"results/{wildcards.scene}/contour.nc"} if swept else {}


# The same to a target volume fraction; how it was reached has a file of its own.
rule packing_to_target:
    input:
        zone_files,
        unpack(contour_of),
        database="results/{scene}/shapes.nc",
        compiled=ancient(kernels_of),
    output:
        packing="results/{scene}/{seed}/packing.nc",
        target="results/{scene}/{seed}/target.nc",
        timing="results/{scene}/{seed}/timing.json",
    wildcard_constraints:
        scene=one_of(TARGETED),
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene(
            "length_unit",
            "domain",
            "size",
            "matched",
            "orientation",
            "arrangement",
            "packing",
            "target",
            "replacement",
        ),
        sources=stages.sources_digest("packing_to_target"),
    message:
        "{wildcards.scene}: packing of seed {wildcards.seed} to its target volume fraction"
    script:
        "../scripts/packing_to_target.py"

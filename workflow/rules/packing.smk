# Hulls packed by the advancing front method.


# One packing a seed; the run time has a file of its own, so that equal input gives equal bytes.
rule packing:
    input:
        database="results/{scene}/shapes.nc",
        compiled=ancient(lambda w: f"results/.{api.search(SCENES[w.scene])}.compiled"),
    output:
        packing="results/{scene}/{seed}/packing.nc",
        timing="results/{scene}/{seed}/timing.json",
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene(
            "length_unit", "domain", "size", "matched", "orientation", "packing"
        ),
        sources=stages.sources_digest("packing"),
    message:
        "{wildcards.scene}: packing of seed {wildcards.seed}"
    script:
        "../scripts/packing.py"

# Outlines, nonconvex as they may be, in the place of their hulls.


# Planned only for scenes with replacement.
rule replacement:
    input:
        database="results/{scene}/shapes.nc",
        packing="results/{scene}/{seed}/packing.nc",
    output:
        nonconvex="results/{scene}/{seed}/nonconvex.nc",
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        sources=stages.sources_digest("replacement"),
    message:
        "{wildcards.scene}: outlines of seed {wildcards.seed}"
    script:
        "../scripts/replacement.py"

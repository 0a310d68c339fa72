# Files for ParaView.


# Planned only for scenes whose outputs name vtk.
rule vtk:
    input:
        packing="results/{scene}/{seed}/{particles}.nc",
    output:
        vtp="results/{scene}/{seed}/{particles}.vtp",
    params:
        sources=stages.sources_digest("vtk"),
    message:
        "{wildcards.scene}: {wildcards.particles} of seed {wildcards.seed} for ParaView"
    script:
        "../scripts/vtk.py"

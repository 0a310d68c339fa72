# From scenes to certified packings: `snakemake` builds the scenes that config/config.yaml names.


include: "workflow/rules/common.smk"
include: "workflow/rules/shapes.smk"
include: "workflow/rules/kernels.smk"
include: "workflow/rules/packing.smk"
include: "workflow/rules/replacement.smk"
include: "workflow/rules/statistics.smk"
include: "workflow/rules/vtk.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/sweep.smk"
include: "workflow/rules/error_vs_time.smk"
include: "workflow/rules/stability.smk"


# Everything that the scenes name.
rule all:
    default_target: True
    input:
        [path for scene in SCENES.values() for path in results_of(scene)],
    message:
        "everything is there, below results/"

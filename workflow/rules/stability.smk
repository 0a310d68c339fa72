# Extreme cases against a moderate one; built by `snakemake stability` alone, whatever the scenes.


# The stability matrix and the growth of rounding errors, with their table and pictures.
rule stability:
    input:
        multiext("results/stability/stability", ".nc", ".md", ".png"),
        "results/stability/clearance.png",
    message:
        "the stability matrix is there, in results/stability/"


# All cases; takes all cores, so that nothing beside it disturbs the times.
rule stability_record:
    output:
        record="results/stability/stability.nc",
    threads: workflow.cores
    params:
        sources=stages.sources_digest("stability"),
    message:
        "stability: all cases, which takes some minutes"
    script:
        "../scripts/stability.py"


rule stability_report:
    input:
        record="results/stability/stability.nc",
    output:
        table="results/stability/stability.md",
        matrix_picture=report(
            "results/stability/stability.png",
            caption="../report/stability.rst",
            category="stability",
            labels={"picture": "extreme cases against a moderate one"},
        ),
        clearance_picture=report(
            "results/stability/clearance.png",
            caption="../report/clearance.rst",
            category="stability",
            labels={"picture": "clearance against rounding"},
        ),
    params:
        sources=stages.sources_digest("stability_report"),
    message:
        "stability: table and pictures"
    script:
        "../scripts/stability_report.py"

# Machine code, compiled once, before the packings that need it start side by side.


# Runs again with the sources of the packing; packings made already do not mind (`ancient`).
rule kernels:
    output:
        compiled=touch("results/.{method}.compiled"),
    params:
        sources=stages.sources_digest("packing"),
    wildcard_constraints:
        method="AFM|OAFM",
    message:
        "kernels of the {wildcards.method}: compiled, or found in the cache"
    script:
        "../scripts/kernels.py"

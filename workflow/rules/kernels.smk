# Machine code, compiled once, before the packings that need it start side by side.


# Runs again with the sources of the packing; packings made already do not mind (`ancient`).
rule kernels:
    output:
        compiled=touch("results/.{search}.compiled"),
    wildcard_constraints:
        search="(arranged_)?(exhaustive|pruned|controlled)(_outlined)?",
    # the longest of the first jobs: the shapes are ready before it ends
    priority: 1
    params:
        sources=stages.sources_digest("packing"),
    message:
        "kernels of the {wildcards.search} search: compiled, or found in the cache"
    script:
        "../scripts/kernels.py"

# Machine code, compiled once, before the packings that need it start side by side.


# The marker is temporary: it is made again, in a second, whenever something is to be packed.
rule kernels:
    output:
        compiled=temp("results/.{method}.compiled"),
    wildcard_constraints:
        method="AFM|OAFM",
    message:
        "kernels of the {wildcards.method}: compiled, or found in the cache"
    script:
        "../scripts/kernels.py"

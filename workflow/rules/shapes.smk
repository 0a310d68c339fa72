# Standardised shapes, from images, an outlines file or a family.


# One database a scene, shared by all its seeds.
rule shapes:
    input:
        image_files,
    output:
        database="results/{scene}/shapes.nc",
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene("shapes"),
        sources=stages.sources_digest("shapes"),
    message:
        "{wildcards.scene}: shapes"
    script:
        "../scripts/shapes.py"

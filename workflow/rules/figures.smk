# Pictures, and with them the report; planned only for scenes whose outputs name figures.


report: "../report/workflow.rst"


def pictures_of(name):
    """A picture of a scene, with its caption in the report."""
    return report(
        f"results/{{scene}}/figures/{name}.png",
        caption=f"../report/{name}.rst",
        category="{scene}",
        labels={"picture": name},
    )


# The first image of a scene, with the outlines found in it.
rule photograph:
    input:
        image_files,
    output:
        picture=pictures_of("photograph"),
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene("shapes"),
        sources=stages.sources_digest("figures"),
    message:
        "{wildcards.scene}: picture of the photograph"
    script:
        "../scripts/photograph.py"


# Signed distances to the zones of the regions.
rule arrangement_picture:
    input:
        zone_files,
    output:
        picture=pictures_of("arrangement"),
    params:
        scene=lambda wildcards: scene_file(wildcards.scene),
        depends_on=of_scene("length_unit", "domain", "arrangement"),
        sources=stages.sources_digest("arrangement_picture"),
    message:
        "{wildcards.scene}: picture of the arrangement"
    script:
        "../scripts/arrangement_picture.py"


def first_packing(wildcards):
    """What is drawn: the packing of the first seed and, with replacement, its outlines."""
    scene = SCENES[wildcards.scene]
    folder = f"results/{scene.name}/{scene.seeds[0]}"
    drawn = {"hulls": f"{folder}/packing.nc", "contacts": f"{folder}/contacts.nc"}
    if scene.replacement:
        drawn["outlines"] = f"{folder}/nonconvex.nc"
    return drawn


# The packing of the first seed, its laws, its contacts and its orientations.
rule figures:
    input:
        unpack(first_packing),
        statistics="results/{scene}/statistics.nc",
    output:
        packing=pictures_of("packing"),
        laws=pictures_of("laws"),
        contacts=pictures_of("contacts"),
        rose=pictures_of("rose"),
    params:
        length_unit=lambda wildcards: SCENES[wildcards.scene].length_unit,
        sources=stages.sources_digest("figures"),
    message:
        "{wildcards.scene}: pictures"
    script:
        "../scripts/figures.py"

"""The header of a dataset, as its contract wants it: JSON Schema, and common data language."""

from __future__ import annotations

from collections.abc import Set
from functools import cache
from typing import Any

from grainfront.files.contract import CONVENTIONS, Contract, Variable

Json = dict[str, Any]


@cache
def json_schema(contract: Contract) -> Json:
    """The JSON Schema of a dataset's header, as `files.dataset.header` gives it."""
    variables = {name: _variable_schema(v) for name, v in contract.variables.items()}
    fixed = {"Conventions": {"const": CONVENTIONS}, "title": {"const": contract.title}}
    free = {name: {"type": a.type, "description": a.description}
            for name, a in contract.attributes.items()}  # fmt: skip
    free_optional = {name for name, a in contract.attributes.items() if a.optional}
    groups = {f"^{name[:-1]}": free.pop(name) for name in list(free) if name.endswith("*")}
    dimensions = {name: {"type": "integer", "minimum": 0, "description": description}
                  for name, description in contract.dimensions.items()}  # fmt: skip
    optional = {name for name, v in contract.variables.items() if v.optional}
    always = {d for v in contract.variables.values() if not v.optional for d in v.dimensions}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"Header of {contract.name}.nc",
        "description": contract.title,
        **_closed(
            {
                "dimensions": _closed(dimensions, optional=set(dimensions) - always),
                "variables": _closed(variables, optional=optional),
                "attributes": _closed({**fixed, **free}, optional=free_optional, groups=groups),
            }
        ),
    }


def _variable_schema(variable: Variable) -> Json:
    attributes: Json = {"long_name": {"const": variable.long_name}}
    if variable.units:
        attributes["units"] = _units_schema(variable.units)
    attributes |= {name: {"const": value} for name, value in variable.attributes.items()}
    return _closed(
        {
            "type": {"const": variable.type},
            "dimensions": {"const": list(variable.dimensions)},
            "attributes": _closed(attributes),
        }
    )


def _units_schema(units: str) -> Json:
    if "{" not in units:
        return {"const": units}
    template, _, power = units.partition("^")
    pattern = rf"^.+\^{power}$" if power else "^.+$"
    attribute = template.strip("{}")
    meaning = f"the global attribute {attribute}" + (f", to the power {power}" if power else "")
    return {"type": "string", "pattern": pattern, "description": meaning}


def _closed(
    properties: Json, *, optional: Set[str] = frozenset(), groups: Json | None = None
) -> Json:
    """An object with these properties, all but the optional ones required, and no other."""
    schema = {
        "type": "object",
        "properties": properties,
        "required": [name for name in properties if name not in optional],
        "additionalProperties": False,
    }
    return schema | ({"patternProperties": groups} if groups else {})


def cdl(contract: Contract) -> str:
    """The header in the common data language of NetCDF, as ``ncdump -h`` prints it.

    What differs from file to file stands in angle brackets.
    """
    lines = [f"netcdf {contract.name} {{", "dimensions:"]
    lines += [f"\t{name} = <{text}> ;" for name, text in contract.dimensions.items()]
    lines += ["variables:"]
    for name, variable in contract.variables.items():
        shape = f"({', '.join(variable.dimensions)})" if variable.dimensions else ""
        note = " // only where the scene has it" if variable.optional else ""
        lines.append(f"\t{variable.type} {name}{shape} ;{note}")
        attributes = {"long_name": variable.long_name, "units": variable.units}
        for key, value in (attributes | variable.attributes).items():
            if value:
                text = value.replace("{", "<").replace("}", ">")
                lines.append(f'\t\t{name}:{key} = "{text}" ;')
    lines += ["", "// global attributes:"]
    lines += [f'\t\t:Conventions = "{CONVENTIONS}" ;', f'\t\t:title = "{contract.title}" ;']
    for name, attribute in contract.attributes.items():
        quote = '"' if attribute.type == "string" else ""
        note = " // only where the scene has it" if attribute.optional else ""
        lines.append(f"\t\t:{name} = {quote}<{attribute.description}>{quote} ;{note}")
    return "\n".join([*lines, "}", ""])

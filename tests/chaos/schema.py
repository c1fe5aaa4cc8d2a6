# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""As much of JSON Schema as docs/schema uses, so that a night needs no package for it."""
import json
import re

TYPES = {"object": dict, "array": list, "string": str, "boolean": bool, "null": type(None), "integer": int,
         "number": (int, float)}
KNOWN = {"$schema", "$ref", "title", "description", "definitions", "type", "enum", "const", "anyOf", "required",
         "properties", "additionalProperties", "items", "minimum", "minItems", "maxItems", "minLength", "pattern"}


def problems(value, schema, root=None, at=""):
    """Sentences about what of a value is not as the schema says."""
    root = root or schema
    if unknown := set(schema) - KNOWN:
        raise ValueError(f"schema.py does not know {unknown}")
    if "$ref" in schema:
        return problems(value, root["definitions"][schema["$ref"].rpartition("/")[2]], root, at)
    if "anyOf" in schema and all(problems(value, one, root, at) for one in schema["anyOf"]):
        return [f"{at}: {json.dumps(value)[:80]} is none of the alternatives"]
    if "enum" in schema and value not in schema["enum"] or "const" in schema and value != schema["const"]:
        return [f"{at}: {json.dumps(value)[:80]} is no value of this member"]
    names = schema.get("type", [])
    names = [names] if isinstance(names, str) else names
    if names and not any(isinstance(value, TYPES[name]) and (name == "boolean" or not isinstance(value, bool)) for name in names):
        return [f"{at}: {json.dumps(value)[:80]} is no {' or '.join(names)}"]
    said = []
    if isinstance(value, (int, float)) and value < schema.get("minimum", value):
        said.append(f"{at}: {value} is too small")
    if isinstance(value, str) and len(value) < schema.get("minLength", 0):
        said.append(f"{at}: it is too short")
    if isinstance(value, str) and not re.search(schema.get("pattern", ""), value):
        said.append(f"{at}: '{value}' is not of the form {schema['pattern']}")
    if isinstance(value, dict):
        said += [f"{at}: {name} is missing" for name in schema.get("required", []) if name not in value]
        members = schema.get("properties", {})
        others = schema.get("additionalProperties", True)
        for name, member in value.items():
            if name in members:
                said += problems(member, members[name], root, f"{at}/{name}")
            elif isinstance(others, dict):
                said += problems(member, others, root, f"{at}/{name}")
            elif not others:
                said.append(f"{at}: {name} has no place here")
    if isinstance(value, list):
        if not schema.get("minItems", 0) <= len(value) <= schema.get("maxItems", len(value)):
            said.append(f"{at}: there are too few or too many")
        for k, item in enumerate(value):
            said += problems(item, schema.get("items", {}), root, f"{at}/{k}")
    return said

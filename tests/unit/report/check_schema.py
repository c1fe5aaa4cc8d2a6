# SPDX-FileCopyrightText: The Edgecase authors
# SPDX-License-Identifier: Apache-2.0
"""check_schema.py SCHEMA FILE: exits 0 if FILE keeps to the JSON schema, and to strict JSON."""
import json
import sys

import jsonschema


def refuse(name):
    raise ValueError(f"{name} is not JSON")


schema, data = (json.load(open(path, encoding="utf-8"), parse_constant=refuse) for path in sys.argv[1:3])
jsonschema.Draft7Validator.check_schema(schema)
jsonschema.Draft7Validator(schema).validate(data)

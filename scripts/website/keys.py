# SPDX-License-Identifier: BSD-3-Clause
"""docs/reference/scenario.schema.json as a page of tables."""
import json

from website.stage import REFERENCE


def options(schema):
    if "oneOf" not in schema or "properties" in schema:
        return [schema]
    return [option for part in schema["oneOf"] for option in options(part)]


def bound(schema):
    parts = [f"{sign} {schema[key]:g}" for key, sign in (("exclusiveMinimum", "&gt;"), ("minimum", "&ge;"),
                                                         ("exclusiveMaximum", "&lt;"), ("maximum", "&le;"))
             if key in schema]
    return f" {', '.join(parts)}" if parts else ""


def describe_type(schema):
    texts = []
    for option in options(schema):
        if "const" in option:
            texts.append(f'`"{option["const"]}"`')
        elif "enum" in option:
            texts += [f'`"{name}"`' for name in option["enum"]]
        elif option["type"] == "object":
            texts.append("table")
        elif option["type"] == "array":
            count = f"{option['minItems']} " if option.get("minItems") == option.get("maxItems") != None else ""
            item = options(option["items"])[0]
            of = "tables" if item["type"] == "object" else f"{item['type']}s{bound(item)}"
            texts.append(f"array of {count}{of}")
        else:
            texts.append(option["type"] + bound(option))
    return ", ".join(dict.fromkeys(texts))


def show_default(schema, is_required):
    if is_required:
        return "required"
    return f"`{json.dumps(schema['default'])}`" if "default" in schema else ""


def describe_table(title, schema):
    lines = [f"### {title}", "", "| key | type | unit | default | |", "|---|---|---|---|---|"]
    for key, part in schema["properties"].items():
        of = options(part)[0] if "description" not in part else part
        lines.append(f"| `{key}` | {describe_type(part)} | {of.get('unit', '')} | "
                     f"{show_default(part, key in schema.get('required', ()))} | {of.get('description', '')} |")
    return [*lines, ""]


def find_tables(schema, name):
    for option in options(schema):
        if option.get("type") == "array":
            within, separator, own = name.rpartition(" / ")
            yield from find_tables(option["items"], f"{within}{separator}[[{own}]]")
        if option.get("type") != "object":
            continue
        if isinstance(option["additionalProperties"], dict):
            yield from find_tables(option["additionalProperties"], f"{name} NAME")
            continue
        kind = next((f" {part['const']}" for part in option["properties"].values() if "const" in part), "")
        yield f"{name}{kind}", option
        for key, part in option["properties"].items():
            yield from find_tables(part, f"{name}{kind} / {key}")


def write(file, tree):
    """Names of the pages."""
    schema = json.loads(file.read_text())
    lines = ["# All keys of a scenario", "",
             "From [its schema](../scenario.schema.json); [with examples](../scenario.md).", ""]
    for key, part in schema["properties"].items():
        lines += [f"## {key}", "", part.get("description", ""), ""]
        for name, table in find_tables(part, key):
            lines += describe_table(name, table)[2 * (name == key):]  # whose heading is that above
    page = f"{REFERENCE}/keys/index.md"
    tree.add(page, "\n".join(lines))
    return [page]

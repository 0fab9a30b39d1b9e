# SPDX-License-Identifier: BSD-3-Clause
"""A page of every public C++ header, from what doxygen reads of it."""
import re
import subprocess
import xml.etree.ElementTree

from website.stage import REFERENCE

OPTIONS = """
QUIET = YES
WARNINGS = NO
GENERATE_HTML = NO
GENERATE_LATEX = NO
GENERATE_XML = YES
XML_PROGRAMLISTING = NO
EXTRACT_ALL = YES
EXTRACT_STATIC = NO
HIDE_UNDOC_RELATIONS = YES
JAVADOC_AUTOBRIEF = YES
MARKDOWN_SUPPORT = NO
"""
# Keeps the lines of equations, sources and limits in comments.
FILTER = r"""sed -E 's,^( *///) (Equation|Source|Limits|Notes?)  +,\1\n\1 \2: ,; s,^( *///) {4}+,\1 <br>,'"""
UMBRELLA = "limber/limber.hpp"


def list_headers(source):
    """Those of the table in docs/reference/compatibility.md, as programs include them; of the one that
    only includes others these, too."""
    page = (source / "docs/reference/compatibility.md").read_text()
    headers = []
    for cell in re.findall(r"^\| ((?:`limber/)[^|]*) \|", page, re.MULTILINE):
        folder, *others = re.findall(r"`([^`]+)`", cell)
        if folder.endswith(".hpp"):
            headers.append(folder)
            folder = folder.rpartition("/")[0] + "/"
        headers += [folder + name for name in others]
    if UMBRELLA not in headers or len(headers) < 10:
        raise RuntimeError("docs/reference/compatibility.md has no table of headers")
    included = re.findall(r'#include "(limber/[\w/]+\.hpp)"',
                          (source / "src" / UMBRELLA).read_text())
    own = [name for name in included if (source / "src" / name).is_file()]
    return [*own, *(name for name in headers if name != UMBRELLA and name not in own)]


def text_of(node):
    """Text of a description, with its lines."""
    if node is None:
        return ""
    parts = []

    def walk(element):
        if element.tag == "parameterlist":
            throws = "Throws " if element.get("kind") == "exception" else ""
            for item in element:
                name, text = ("".join(item[i].itertext()).strip() for i in (0, 1))
                parts.append(f"\n{throws}{name}: {text}\n")
            return
        if element.tag in ("para", "simplesect", "linebreak"):
            parts.append("\n")
        if element.tag == "simplesect" and element.get("kind") == "return":
            parts.append("Returns ")
        parts.append(element.text or "")
        for child in element:
            walk(child)
            parts.append(child.tail or "")
    walk(node)
    return re.sub(r"\s*\n\s*", "\n", re.sub(r"[ \t]+", " ", "".join(parts))).strip()


def name_of(node):
    return re.sub(r"^.*::", "", node.findtext("name") or node.findtext("compoundname") or "")


def break_up(declaration):
    """A long one with an argument a line."""
    text = declaration.replace("< ", "<").replace(" >", ">").replace(" &", "& ").replace(" *", "* ")
    if len(text) <= 90:
        return text
    head, _, arguments = text.partition("(")
    lines, depth = [""], 0
    for letter in arguments:
        depth += letter in "<({"
        depth -= letter in ">)}"
        lines[-1] += letter
        if letter == "," and depth == 0:
            lines.append("")
    return f"{head}(\n    " + "\n    ".join(line.strip() for line in lines)


def declare(member):
    """One declaration on a line or two."""
    kind, name = member.get("kind"), name_of(member)
    its = re.sub(r"\s+", " ", "".join(member.find("type").itertext())) if member.find("type") is not None else ""
    if kind == "function":
        return break_up(f"{its} {name}{member.findtext('argsstring') or ''};".strip())
    if kind == "enum":
        values = ", ".join(value.findtext("name") for value in member.findall("enumvalue"))
        return f"enum class {name} {{ {values} }};"
    if kind == "typedef":
        return f"using {name} = {its};"
    return f"{its} {name} {member.findtext('initializer') or ''}".strip() + ";"


def describe_member(member, level):
    text = "\n\n".join(filter(None, (text_of(member.find("briefdescription")),
                                     text_of(member.find("detaileddescription")))))
    lines = [f"{'#' * level} {name_of(member)}", ""] if level else []
    lines += ["```cpp", declare(member), "```", ""]
    return lines + ([f"<div class=\"said\">{escape(text)}</div>", ""] if text else [])


def escape(text):
    return text.replace("&", "&amp;").replace("<", "&lt;").replace("\n\n", "<br>").replace("\n", "<br>")


def read_compound(folder, reference):
    return xml.etree.ElementTree.parse(folder / f"{reference}.xml").getroot()[0]


def is_in(node, header):
    """Whether what doxygen describes is in a header."""
    place = node.find("location")
    return place is not None and place.get("file").endswith("/" + header.removeprefix("limber/"))


def describe_class(folder, reference):
    compound = read_compound(folder, reference)
    if compound.get("prot") == "private":
        return []
    text = "\n\n".join(filter(None, (text_of(compound.find("briefdescription")),
                                     text_of(compound.find("detaileddescription")))))
    name = re.sub(r"^limber::(\w+::)?", "", compound.findtext("compoundname"))
    lines = [f"## {compound.get('kind')} {name}", "", f"<div class=\"said\">{escape(text)}</div>", ""]
    for member in compound.iter("memberdef"):
        if member.get("prot") == "public" and member.get("kind") != "friend":
            lines += describe_member(member, 0)
    return lines


def describe_header(folder, header, compound):
    namespaces = [text for text in (node.text for node in compound.findall("innernamespace"))
                  if text != "limber"]
    lines = [f"# {header.rpartition('/')[2]}", "", "```cpp", f'#include "{header}"', "```", ""]
    if namespaces:
        lines += [f"In namespace `{namespaces[0]}`.", ""]
    for inner in compound.findall("innerclass"):
        if inner.get("prot") == "public" and "detail" not in inner.text:
            lines += describe_class(folder, inner.get("refid"))
    free = []
    for inner in compound.findall("innernamespace"):
        space = read_compound(folder, inner.get("refid"))
        free += [member for member in space.findall("sectiondef/memberdef") if is_in(member, header)]
    for member in free:
        lines += describe_member(member, 2)
    return "\n".join(lines)


def write(source, work, tree):
    """Names of the pages."""
    headers = list_headers(source)
    work.mkdir()
    inputs = " ".join(f'"{(source / "src" / header).resolve()}"' for header in headers)
    (work / "Doxyfile").write_text(OPTIONS + f"INPUT = {inputs}\nOUTPUT_DIRECTORY = {work}\n"
                                   f'INPUT_FILTER = "{FILTER}"\n')
    subprocess.run(["doxygen", work / "Doxyfile"], check=True, capture_output=True)
    folder, pages = work / "xml", []
    index = ["# C++: public headers", "",
             "[What public means](../compatibility.md#c), [how to link](../../how-to/use_the_library.md).", ""]
    compounds = []
    for entry in xml.etree.ElementTree.parse(folder / "index.xml").getroot():
        if entry.get("kind") == "file":
            compounds.append(read_compound(folder, entry.get("refid")))
    for header in headers:
        compound = next(one for one in compounds if is_in(one, header))
        name = header.removeprefix("limber/").removesuffix(".hpp").replace("/", "_")
        pages.append(f"{REFERENCE}/cpp/{name}.md")
        tree.add(pages[-1], describe_header(folder, header, compound))
        index.append(f"- [{header}]({name}.md)")
    tree.add(f"{REFERENCE}/cpp/index.md", "\n".join(index) + "\n")
    return [f"{REFERENCE}/cpp/index.md", *pages]

"""Print the commands of a recipe for conda, as conda-build would run them on Linux.

    conda.py meta.yaml script     those that build
    conda.py meta.yaml test       those that test, after the files that they need are copied

What conda-build offers to templates is replaced by stand-ins. A section or a key that conda-build
does not know is an error.
"""

import sys

import jinja2
import yaml

KEYS = {
    "package": {"name", "version"},
    "source": {"path", "url", "sha256"},
    "build": {"number", "skip", "run_exports", "script"},
    "requirements": {"build", "host", "run", "run_constrained"},
    "test": {"source_files", "commands"},
    "about": {"summary", "license", "license_file", "home", "doc_url", "dev_url"},
    "extra": {"recipe-maintainers"},
}


def main(path: str, part: str) -> None:
    """Print one part of the recipe in the file `path`."""
    stand_ins = {
        "compiler": lambda language: f"{language}-compiler",
        "stdlib": lambda language: f"{language}-stdlib",
        "pin_subpackage": lambda name, max_pin: f"{name} {max_pin}",
    }
    with open(path, encoding="utf-8") as file:
        lines = [line for line in file if "# [not linux]" not in line]
    template = jinja2.Environment(undefined=jinja2.StrictUndefined).from_string("".join(lines))
    recipe = yaml.safe_load(template.render(stand_ins))
    for section, content in recipe.items():
        unknown = set(content) - KEYS[section]
        if unknown:
            sys.exit(f"{path}: {section} has no {', '.join(sorted(unknown))}")
    if part == "script":
        print("\n".join(recipe["build"]["script"]))
        return
    for name in recipe["test"]["source_files"]:
        print(f'mkdir -p "$(dirname {name})" && cp "$SRC_DIR/{name}" {name}')
    print("\n".join(recipe["test"]["commands"]))


main(*sys.argv[1:])

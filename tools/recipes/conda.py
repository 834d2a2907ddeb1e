"""Build a recipe for conda with rattler-build, and run its tests.

    conda.py RECIPE_FOLDER OUT      the package lands in OUT, and its files in OUT/prefix

The packages of conda-forge that the recipe needs are not on PyPI. Empty ones of the same names
stand in for them, in a channel that is made here: compilers, tools and libraries are those of this
machine. The stand-in for the compiler sets CMAKE_ARGS as conda-forge's does, without optimisation:
quick to compile; the code itself is tested elsewhere.
"""

import asyncio
import os
import sys
from pathlib import Path

from rattler import install, solve
from rattler.index import index_fs
from rattler_build import (
    Stage0Recipe,
    ToolConfiguration,
    VariantConfig,
    assemble_package,
)

COMPILER = "gcc_linux-64"
STAND_INS = {
    COMPILER: "12.2",
    "sysroot_linux-64": "2.28",
    "cmake": "3.25",
    "ninja": "1.11",
    "pkg-config": "0.29",
    "cairo": "1.16",
    "jansson": "2.14",
    "libgdal-core": "3.6",
    "zlib": "1.2.13",
}
ACTIVATE = """export CMAKE_ARGS="-DCMAKE_INSTALL_PREFIX=$PREFIX -DCMAKE_INSTALL_LIBDIR=lib \\
-DCMAKE_C_FLAGS_RELEASE=-O0"
"""


async def make_channel(channel: Path) -> None:
    """Make a channel of empty packages."""
    for name, version in STAND_INS.items():
        files = channel / "files" / name
        files.mkdir(parents=True)
        if name == COMPILER:
            script = files / "etc/conda/activate.d/compiler.sh"
            script.parent.mkdir(parents=True)
            script.write_text(ACTIVATE)
        assemble_package(name, version, "linux-64", "0", channel / "linux-64", files_dir=files)
    await index_fs(channel)


async def main(recipe: Path, out: Path) -> None:
    """Build and test the recipe in the folder `recipe`."""
    channel = out / "channel"
    (channel / "linux-64").mkdir(parents=True)
    await make_channel(channel)
    variants = VariantConfig(
        {"c_compiler": ["gcc"], "c_stdlib": ["sysroot"], "c_stdlib_version": ["2.28"]}
    )
    [rendered] = Stage0Recipe.from_file(recipe / "recipe.yaml").render(variants)
    made = out / "made"
    result = rendered.run_build(
        tool_config=ToolConfiguration(test_strategy="native"),
        output_dir=made,
        channels=[channel.as_uri()],
    )
    print("\n".join(result.log))
    records = await solve(
        [made.as_uri(), channel.as_uri()], ["meshwalk"], platforms=["linux-64", "noarch"]
    )
    await install(records, out / "prefix", cache_dir=out / "cache")


asyncio.run(main(*(Path(argument).resolve() for argument in sys.argv[1:])))
sys.stdout.flush()
os._exit(0)  # rattler 0.28 crashes now and then when Python ends, with all done

"""Conan 2: `conan create packaging/conan` makes the library of this tree a package."""

import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rmdir

TREE = ("CMakeLists.txt", "LICENSE", "README.md", "CHANGELOG.md")
FOLDERS = ("cmake", "docs/man", "include", "mpi", "src", "tools", "web/platform")


class Meshwalk(ConanFile):
    name = "meshwalk"
    license = "MIT"
    description = "Exact point location in triangle meshes by walking"
    topics = ("mesh", "triangulation", "point-location", "geometry")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {
        "shared": [True, False],
        "fPIC": [True, False],
        "with_zlib": [True, False],
        "with_jansson": [True, False],
    }
    default_options = {"shared": False, "fPIC": True, "with_zlib": True, "with_jansson": True}
    implements = ["auto_shared_fpic"]
    languages = "C"

    def set_version(self):
        header = Path(self.recipe_folder, "../../include/meshwalk/version.h").read_text()
        self.version = re.search(r'MW_VERSION_STRING "(.*)"', header).group(1)

    def export_sources(self):
        tree = Path(self.recipe_folder, "../..").resolve()
        for pattern in (*TREE, *(f"{folder}/*" for folder in FOLDERS)):
            copy(self, pattern, tree, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        if self.options.with_zlib:
            self.requires("zlib/[>=1.2.11 <2]")
        if self.options.with_jansson:
            self.requires("jansson/[>=2.11 <3]")

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update(
            MW_BUILD_CLI=False,
            MW_BUILD_MPI=False,
            MW_BUILD_WEB=False,
            MW_INSTALL_SHARED=bool(self.options.shared),
            MW_INSTALL_STATIC=not self.options.shared,
            MW_WITH_ZLIB=bool(self.options.with_zlib),
            MW_WITH_JANSSON=bool(self.options.with_jansson),
        )
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder, "licenses")))
        # Conan's own files for CMake and pkg-config take the place of these.
        rmdir(self, str(Path(self.package_folder, "lib/cmake")))
        rmdir(self, str(Path(self.package_folder, "lib/pkgconfig")))
        rmdir(self, str(Path(self.package_folder, "share")))

    def package_info(self):
        self.cpp_info.libs = ["meshwalk"]
        self.cpp_info.system_libs = ["m", "pthread", "dl"]
        self.cpp_info.set_property("cmake_file_name", "meshwalk")
        self.cpp_info.set_property("pkg_config_name", "meshwalk")
        target = "meshwalk::meshwalk" if self.options.shared else "meshwalk::meshwalk_static"
        self.cpp_info.set_property("cmake_target_name", target)
        if not self.options.shared:
            self.cpp_info.set_property("cmake_target_aliases", ["meshwalk::meshwalk"])

# Stand-ins for what the recipe for Nix takes of nixpkgs, which is not in Debian: the packages that
# it names are those of this machine, and mkDerivation builds with the options that the hook of
# nixpkgs for CMake gives. Quick to compile; the code itself is tested elsewhere.
{ recipe }:
let
  names = [ "cairo" "cmake" "gdal" "jansson" "netcdf" "ninja" "patchelf" "pkg-config" "zlib" ];
  packages = builtins.listToAttrs (map (name: { inherit name; value = "/usr"; }) names);
  phases = ''
    set -eux
    export PATH=/usr/bin:/bin HOME=/homeless
    cmake -G Ninja -S $src -B build $cmakeFlags -DCMAKE_BUILD_TYPE=Release \
      -DCMAKE_C_FLAGS_RELEASE=-O0 -DCMAKE_INSTALL_PREFIX=$out -DCMAKE_INSTALL_BINDIR=$out/bin \
      -DCMAKE_INSTALL_LIBDIR=$out/lib -DCMAKE_INSTALL_INCLUDEDIR=$out/include \
      -DCMAKE_INSTALL_MANDIR=$out/share/man -DCMAKE_INSTALL_DOCDIR=$out/share/doc/meshwalk
    cmake --build build
    cmake --install build
  '';
in
import recipe {
  pkgs = packages // {
    lib = {
      cleanSource = source: builtins.path { name = "source"; path = source; };
      licenses.mit = "mit";
      makeLibraryPath = list: builtins.concatStringsSep ":" (map (package: package + "/lib") list);
      platforms.linux = [ "x86_64-linux" ];
    };
    stdenv.mkDerivation =
      { pname, version, src, cmakeFlags, postFixup, meta, ... }:
      derivation {
        name = "${pname}-${version}";
        system = builtins.head meta.platforms;
        builder = "/bin/bash";
        args = [ "-c" (phases + postFixup) ];
        inherit src cmakeFlags;
      };
  };
}

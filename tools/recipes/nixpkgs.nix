# Stand-ins for what the recipe for Nix takes of nixpkgs: packages are their names, and what
# mkDerivation is called with is the result.
{ recipe }:
let
  names = [ "cairo" "cmake" "gdal" "jansson" "netcdf" "ninja" "patchelf" "pkg-config" "zlib" ];
  packages = builtins.listToAttrs (map (name: { inherit name; value = "/nix/${name}"; }) names);
in
import recipe {
  pkgs = packages // {
    lib = {
      cleanSource = source: assert builtins.pathExists (source + "/CMakeLists.txt"); "source";
      licenses.mit = "mit";
      makeLibraryPath = list: builtins.concatStringsSep ":" (map (package: package + "/lib") list);
      platforms.linux = [ "linux" ];
    };
    stdenv.mkDerivation = arguments: arguments;
  };
}

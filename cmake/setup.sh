# Sourced by ./demo and ./check: installs what is missing on a Debian machine.

build_packages=(g++ cmake ninja-build libembree-dev libopenimageio-dev openimageio-tools libpng-dev libtbb-dev libhwy-dev
                libglm-dev libcli11-dev libtomlplusplus-dev libfmt-dev nlohmann-json3-dev libssl-dev libqhull-dev)
test_packages=(catch2 libcgal-dev libosd-dev povray)
bench_packages=(povray blender libopenvdb-dev libosd-dev python3-vtk9)  # for bench/report, which goes without them too

setup_packages() {
  local missing=() package
  for package in "$@"; do
    dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
  done
  if [ ${#missing[@]} -eq 0 ]; then return; fi
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null || { echo "These packages are missing, and only root can install them: ${missing[*]}" >&2; exit 1; }
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}

# SPDX-License-Identifier: GPL-3.0-or-later
# For scripts to source: the models that they go through. Needs the sources (SOURCE).

# machines NAME...: model files, a line each: a file as it is, else the model of systems/ of that name. Without a name all of systems/ but
# parts, which machines are made of, and controllers, which move nothing.
machines() {
  local name
  [ $# -gt 0 ] || find "$SOURCE/systems" -name '*.toml' -not -path '*/book/*' -not -path '*/parts/*' -not -path '*/controllers/*' | sort
  for name in "$@"; do
    if [ -f "$name" ]; then realpath "$name"; else printf "%s\n" "$SOURCE"/systems/*/"$name".toml; fi
  done
}

# The same, but with parts among all.
machines_and_parts() {
  machines "$@"
  [ $# -gt 0 ] || find "$SOURCE/systems/parts" -name '*.toml' | sort
}

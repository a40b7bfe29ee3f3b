#!/usr/bin/env bash
# The first step of the action: installs a package of parity, or checks that there is a parity already.
# PARITY_DEB, or PARITY_VERSION with PARITY_REPOSITORY, or neither; PARITY_SHA256.
set -euo pipefail
fail() { echo "::error title=parity::$*" && exit 64; }
sudo=()
[ "$(id -u)" = 0 ] || sudo=(sudo)

[ -z "$PARITY_DEB" ] || [ -z "$PARITY_VERSION" ] || fail "give 'deb' or 'version', not both"
if [ -n "$PARITY_VERSION" ]; then
  [[ $PARITY_VERSION =~ ^[0-9]+\.[0-9]+\.[0-9]+$ ]] || fail "version: not of the form 0.2.0"
  [[ $PARITY_REPOSITORY =~ ^[A-Za-z0-9._-]+/[A-Za-z0-9._-]+$ ]] || fail "repository: not of the form OWNER/NAME"
  if ! command -v curl >/dev/null; then
    "${sudo[@]}" apt-get update -qq
    "${sudo[@]}" apt-get install -y -qq --no-install-recommends curl ca-certificates
  fi
  name=parity_$PARITY_VERSION-1_$(dpkg --print-architecture).deb
  PARITY_DEB=$RUNNER_TEMP/$name
  curl --fail --silent --show-error --location --retry 3 --output "$PARITY_DEB" \
    "$GITHUB_SERVER_URL/$PARITY_REPOSITORY/releases/download/v$PARITY_VERSION/$name" ||
    fail "$name: not among the releases of $PARITY_REPOSITORY"
fi
if [ -n "$PARITY_DEB" ]; then
  [ -f "$PARITY_DEB" ] || fail "deb: no such file"
  if [ -n "$PARITY_SHA256" ]; then
    echo "$PARITY_SHA256  $PARITY_DEB" | sha256sum --check --strict --quiet - || fail "sha256: the package has another one"
  fi
  # apt takes a file where the name has a slash.
  "${sudo[@]}" apt-get update -qq
  "${sudo[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$(realpath "$PARITY_DEB")" >/dev/null ||
    fail "the package cannot be installed: it is for Debian 12 (container: debian:12)"
elif [ -n "$PARITY_SHA256" ]; then
  fail "sha256: of no package; give 'deb' or 'version', too"
fi
command -v parity >/dev/null || fail "no parity is on the PATH: give 'deb' or 'version'"
parity --version

#!/usr/bin/env bash
# scripts/test-package takes minutes and the network: only where it is asked for.
set -euo pipefail
if [ -z "${PARITY_TEST_PACKAGE:-}" ]; then
  echo "skipped: PARITY_TEST_PACKAGE=1 makes a bare Debian 12 and installs the package there (scripts/test-package)"
  exit 77
fi
exec scripts/test-package

#!/usr/bin/env bash
# What `cmake --install` makes holds what it is to hold, and runs where it is moved to, without a thing of the build.
#   relocated.sh CMAKE BUILD_FOLDER
set -euo pipefail
cmake=$1 build=$(cd "$2" && pwd)
here=$(cd "$(dirname "$0")" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "FAILED: $*" && exit 1; }

"$cmake" --install "$build" --prefix "$work/first" >/dev/null
mkdir "$work/another place" "$work/home"
root="$work/another place/parity"
mv "$work/first" "$root"

# The files, but for the documents of docs/, which come and go.
(cd "$root" && find . -type f ! -path './share/doc/parity/docs/*' | LC_ALL=C sort) >"$work/files"
diff -u "$here/installed_files.txt" "$work/files" || fail "other files than tests/package/installed_files.txt names"
documents=$root/share/doc/parity
[ -s "$documents/docs/install.md" ] || fail "the documents are missing"

# Every link from one document to another holds.
links=0
while IFS=: read -r file link; do
  link=${link#](} link=${link%[)#]}
  [ -e "$(dirname "$file")/$link" ] || fail "$file: '$link' leads nowhere"
  links=$((links + 1))
done < <(find "$documents" -name '*.md' -exec grep -HoE '\]\([^)#: ]+[)#]' {} +)
[ "$links" -gt 50 ] || fail "only $links links were found"

grep -q '^Draco' "$documents/copyright" || fail "the licence of what is linked is missing"
! grep -q '\.\./out' "$root/share/parity/suites/demo.toml" || fail "demo.toml leads out of its folder"

program=$root/bin/parity
readelf -d "$program" | grep -qF '[$ORIGIN/../lib/parity]' || fail "the program looks elsewhere for its libraries"
for file in "$program" "$root"/lib/parity/*; do
  readelf -S "$file" | grep -q '\.debug_info' && continue # which names the sources
  ! grep -qF "$build" "$file" || fail "$file names the build folder"
done

# Without any variable of the environment but a home. LD_DEBUG says which libraries are loaded.
run() {
  env -i HOME="$work/home" ASAN_OPTIONS=detect_leaks=0 LD_DEBUG=files LD_DEBUG_OUTPUT="$work/loaded" "$program" "$@"
}
cd "$work"
# The third line, the device, depends on the environment.
[ "$(run --version | head -2)" = "$("$build/parity" --version | head -2)" ] || fail "another version"
man=$root/share/man/man1
for page in "$man"/*.gz; do gzip -dc "$page" | grep -q '^\.SH "\?EXIT STATUS' || fail "$page has no exit codes"; done
bash -n "$root/share/bash-completion/completions/parity" || fail "the completion of bash is broken"
status=0
# Over budget (2) is an answer.
run report builtin:spheres --env builtin:white --prefilter-size 64 --prefilter-samples 8 --material checker --size 128x128 \
  --mobile-textures etc2 --no-cache -q -o out || status=$?
[ "$status" -le 2 ] || fail "exit code $status"
for file in report.json run.json junit.xml; do [ -s "out/$file" ] || fail "no $file"; done
run flip "$(ls out/images/*.png | head -1)" "$(ls out/images/*.png | head -1)" >/dev/null
run render builtin:spheres --path mobile --size 32x32 --no-cache -q -o sphere.exr
printf 'P6\n2 2\n255\nabcdefghijkl' >four.ppm && run flip four.ppm four.ppm >/dev/null # by the module of images
run budget check "$root/share/parity/budgets.example.toml" >/dev/null

for library in libparity_draco parity_imageio parity_etc2; do
  cat loaded.* | sed -n "s|.*calling init: \(.*/$library\.so\)$|\1|p" | sort -u >"$library"
  [ "$(cat "$library")" = "$(realpath "$root/bin")/../lib/parity/$library.so" ] || [ "$(cat "$library")" = "$root/lib/parity/$library.so" ] ||
    fail "$library.so is loaded from '$(cat "$library")'"
done
echo "$(wc -l <files) files, $links links"

#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Installs Julia on Debian. Where the machine's own release has no Julia, the package of Debian 11
# (bullseye) is taken from the mirror that the machine already uses. The older release is pinned
# low and is asked for this one package; nothing installed is upgraded, downgraded or removed, and
# apt's configuration is left as it was found.
set -euo pipefail

say() { printf 'install_julia: %s\n' "$*"; }

# Julia 1.5 with a libunwind newer than 1.3 crashes where an exception passes through compiled code.
works() {
    command -v julia > /dev/null &&
        julia --startup-file=no -e 'f(n) = n > 0 ? f(n - 1) + 1 : error(); try f(9) catch end' \
            > /dev/null 2>&1
}

if works; then
    say "$(julia --version) is here already"
    exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then as_root=(sudo); fi
install() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
        apt-get install -y -q --no-install-recommends --no-remove "$@"
}

on_offer() { [ -n "$(apt-cache madison julia 2> /dev/null)" ]; }

"${as_root[@]}" apt-get update -q
if ! command -v julia > /dev/null && on_offer; then
    install julia
    if works; then
        julia --version
        exit 0
    fi
fi

release=bullseye
source_file=/etc/apt/sources.list.d/wfpsf-julia.list
pin_file=/etc/apt/preferences.d/wfpsf-julia
keyring=/usr/share/keyrings/debian-archive-keyring.gpg
forget() { "${as_root[@]}" rm -f "$source_file" "$pin_file"; }
trap forget EXIT

"${as_root[@]}" tee "$pin_file" > /dev/null << END
Package: *
Pin: release n=$release
Pin-Priority: 100
END

# Debian's own archives in apt's configuration, without the security archive.
# shellcheck disable=SC2016  # apt-get expands these
mirrors=$(apt-get indextargets --format '$(ORIGIN)/$(LABEL) $(REPO_URI)' 'Created-By: Packages' |
    sed -n 's|^Debian/Debian ||p' | sort -u)
[ -n "$mirrors" ] || { say "no Debian mirror in apt's configuration"; exit 1; }

# A release that has left the mirror's main tree stands beside it, under archive or debian-archive.
candidates() {
    local mirror base
    for mirror in $mirrors; do
        base=${mirror%/}
        printf '%s\n' "$base" "${base%/*}/archive/${base##*/}" "${base%/*}/debian-archive/${base##*/}"
    done
}

found=
while read -r uri; do
    say "looking for $release at $uri"
    printf 'deb [signed-by=%s] %s %s main\n' "$keyring" "$uri" "$release" |
        "${as_root[@]}" tee "$source_file" > /dev/null
    # Only this source is read, and the lists of the others are kept.
    if "${as_root[@]}" apt-get update -q -o Dir::Etc::SourceList="$source_file" \
        -o Dir::Etc::SourceParts=- -o APT::Get::List-Cleanup=0 \
        -o APT::Update::Error-Mode=any && on_offer; then
        found=$uri
        break
    fi
done < <(candidates)
[ -n "$found" ] || { say "$release is on none of the machine's mirrors"; exit 1; }

if ! command -v julia > /dev/null; then
    plan=$(apt-get install -s --no-install-recommends --no-remove julia)
    changed=$(sed -n 's/^Inst \([^ ]*\) \[.*/\1/p' <<< "$plan")
    [ -z "$changed" ] || { say "would replace installed packages: $changed"; exit 1; }
    install julia
fi

# The libunwind that this Julia was made with goes into Julia's own folder of libraries, which no
# other program looks into.
if ! works; then
    folder=$(mktemp -d)
    (cd "$folder" && apt-get download -q "libunwind8/$release" && dpkg-deb -x libunwind8_*.deb .)
    library=$(find "$folder" -name 'libunwind.so.8.*' -type f)
    own=$(dirname "$(find /usr/lib -path '*/julia/*' -name 'sys.so' | head -n 1)")
    "${as_root[@]}" cp "$library" "$own/libunwind.so.8"
    rm -r "$folder"
fi
works || { say "julia crashes on an exception"; exit 1; }
julia --version

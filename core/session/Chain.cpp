#include "core/session/Chain.h"

#include <fmt/format.h>
#include <iterator>
#include <string>

namespace tacto {

Digest chainHash(const Digest& previous, const Entry& entry) {
    std::string bytes(previous.begin(), previous.end());
    fmt::format_to(std::back_inserter(bytes), "{}\n{}\n{}\n{}:", entry.seq, entry.t_ns, entry.kind, entry.name.size());
    bytes.append(entry.name);
    fmt::format_to(std::back_inserter(bytes), "\n{}:", entry.body.size());
    bytes.append(entry.body);
    fmt::format_to(std::back_inserter(bytes), "\n{}\n", entry.digest ? hexText(*entry.digest) : "-");
    return sha256(bytes);
}

}  // namespace tacto

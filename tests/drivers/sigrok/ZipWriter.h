// ZipWriter.h - makes zip archives for tests: broken ones, and large ones in little time.
//
// Thread-safety: the test's own thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tacto::test {

/// `level` is zlib's compression level; 0 = stored.
[[nodiscard]] std::string zipOf(const std::vector<std::pair<std::string, std::string>>& entries, int level = 0);

}  // namespace tacto::test

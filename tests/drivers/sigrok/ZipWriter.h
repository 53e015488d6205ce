// ZipWriter.h - zip archives for tests: files that no program would write, and large ones soon written.
//
// Thread-safety: the test's own thread.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tacto::test {

/// `level`: zlib's, 0 = stored.
[[nodiscard]] std::string zipOf(const std::vector<std::pair<std::string, std::string>>& entries, int level = 0);

}  // namespace tacto::test

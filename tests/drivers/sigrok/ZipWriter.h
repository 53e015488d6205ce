// ZipWriter.h - small zip archives of stored entries, for files that no program would write.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace tacto::test {

[[nodiscard]] std::string zipOf(const std::vector<std::pair<std::string, std::string>>& entries);

}  // namespace tacto::test

// OwnFile.h - whether a file with a secret, and the folder that keys lie in, are this account's alone (hazard H11), as
// ssh asks it of a private key.
//
// Thread-safety: any thread; looks at files.
#pragma once

#include <filesystem>
#include <string_view>

#include "core/base/Result.h"

namespace tacto {

/// The open file `descriptor` belongs to this account or to root, and no one else may read or change it. `what` it is
/// stands in the sentence: "the key file". A terminal is not asked. Errors: NotFound, naming the mode or the owner.
[[nodiscard]] Result<void> isOwnFile(int descriptor, const std::filesystem::path& file, std::string_view what);
/// The same by name; a link counts as what it names.
[[nodiscard]] Result<void> isOwnFile(const std::filesystem::path& file, std::string_view what);
/// The folder belongs to this account or to root, and no one else may put another file into it.
[[nodiscard]] Result<void> isOwnFolder(const std::filesystem::path& folder, std::string_view what);

}  // namespace tacto

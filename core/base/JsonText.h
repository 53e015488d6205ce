// JsonText.h - the one reader for JSON text that comes from outside: profiles, limit sets, templates, recordings,
// calibrations, rows of session files.
//
// JSON leaves open what a key that stands twice means, how deep it may nest and how large a number may be; here all of
// that is refused, by name (hazard H10: a key that stands twice loses a ceiling, 400 000 brackets lose the stack).
// tests/base/JsonTextTest.cpp checks that no other parser is called in core, drivers and app.
//
// Thread-safety: pure functions, but for documentsIn(), which reads a folder. No exception whatever the text, memory
// apart.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <limits>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/Result.h"

namespace tacto {

struct JsonLimits {
    std::size_t bytes = 1'000'000;
    int depth = 32;  ///< objects and lists within each other
    std::size_t values = std::numeric_limits<std::size_t>::max();
};

/// `source` begins every message: the file, and the line in it where that is known. Errors: ParseError for a text that
/// is too long, nests too deep, is not JSON or not UTF-8, continues after its end, has a null byte, a key twice in one
/// object, or a number beyond the range of double.
[[nodiscard]] Result<nlohmann::json> parseJson(std::string_view text, std::string_view source,
                                               const JsonLimits& limits = {});

/// Reads values in binary form, as another process of the program sends them (CBOR, RFC 8949): NaN and infinities are
/// values there. Errors: ParseError for bytes that are too many, nest too deep, hold more than `limits.values` values,
/// are not CBOR whose items state their lengths, or continue after its end, and for a key twice in one object.
[[nodiscard]] Result<nlohmann::json> parseCbor(std::string_view bytes, std::string_view source,
                                               const JsonLimits& limits);
void appendCbor(const nlohmann::json& value, std::string& to);

/// The *.json of a folder, by file name. Errors: NotFound for a folder that cannot be read.
[[nodiscard]] Result<std::vector<std::filesystem::path>> documentsIn(const std::filesystem::path& folder);
/// `error` as a fault of the file that it was found in, or of a caller's argument.
[[nodiscard]] inline Error asParseError(Error error) { return {ErrorCode::ParseError, std::move(error.message)}; }
[[nodiscard]] inline Error asInvalidArgument(Error error) {
    return {ErrorCode::InvalidArgument, std::move(error.message)};
}

/// `where` begins the message: "lab.json: limits[2]". Errors: ParseError for anything but an object.
[[nodiscard]] Result<void> expectObject(const nlohmann::json& value, std::string_view where);
/// Whether `value` is an object that has no keys other than `known`. Errors: ParseError naming the first unknown key,
/// and the known ones.
[[nodiscard]] Result<void> onlyKeys(const nlohmann::json& value, std::span<const std::string_view> known,
                                    std::string_view where);
[[nodiscard]] inline Result<void> onlyKeys(const nlohmann::json& value, std::initializer_list<std::string_view> known,
                                           std::string_view where) {
    return onlyKeys(value, std::span(known.begin(), known.size()), where);
}

/// Bytes that are not UTF-8 become U+FFFD instead of an exception; `indent` of -1 gives one line, `ascii` escapes.
[[nodiscard]] std::string dumpJson(const nlohmann::json& value, int indent = -1, bool ascii = false);
/// One line for a message, at most 60 characters, whatever the value holds.
[[nodiscard]] std::string shownJson(const nlohmann::json& value);

// Fields of a JSON object that may be missing or of another type: rows of a damaged file are read too.

/// Limits of one row of a session file: results and report items are large, and a script's values nest by themselves.
inline constexpr JsonLimits kRowLimits{.bytes = 256'000'000, .depth = 64};

[[nodiscard]] std::string textOr(const nlohmann::json& object, const char* key);
/// NaN where there is no number: null is how NaN is written.
[[nodiscard]] double numberOr(const nlohmann::json& object, const char* key);
[[nodiscard]] double numberOr(const nlohmann::json& value);
[[nodiscard]] std::uint64_t countOr(const nlohmann::json& object, const char* key);
[[nodiscard]] bool flagOr(const nlohmann::json& object, const char* key);
[[nodiscard]] std::vector<std::string> textsOr(const nlohmann::json& object, const char* key);
/// The value as JSON; null for NaN and infinity.
[[nodiscard]] nlohmann::json numberOrNull(double value);
/// The member of that name; null where there is none.
[[nodiscard]] nlohmann::json valueOr(const nlohmann::json& object, const char* key);

}  // namespace tacto

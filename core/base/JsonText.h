// JsonText.h - the only reader for JSON text from outside: profiles, limit sets, templates, recordings, calibrations,
// rows of session files.
//
// JSON does not define what a repeated key means, how deep values may nest or how large a number may be; this reader
// refuses such texts and names the fault (hazard H10: a repeated key loses a ceiling, 400 000 brackets overflow the
// stack). tests/base/JsonTextTest.cpp checks that core, drivers and app use no other parser.
//
// Thread-safety: pure functions, except for documentsIn(), which reads a folder. No text causes an exception, except
// for lack of memory.
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
    int depth = 32;  ///< nesting of objects and lists
    std::size_t values = std::numeric_limits<std::size_t>::max();
};

/// Each message begins with `source`: the file, with the line if known. Errors: ParseError for a text that is too long,
/// nests too deep, is not JSON or not UTF-8, continues after its end, contains a null byte, has a key twice in one
/// object, or has a number beyond the range of double.
[[nodiscard]] Result<nlohmann::json> parseJson(std::string_view text, std::string_view source,
                                               const JsonLimits& limits = {});

/// Reads values in binary form (CBOR, RFC 8949) from another process of the program; NaN and infinities are allowed.
/// Errors: ParseError for bytes that are too many, nest too deep, contain more than `limits.values` values, are not
/// CBOR with stated lengths, or continue after their end, and for a key twice in one object.
[[nodiscard]] Result<nlohmann::json> parseCbor(std::string_view bytes, std::string_view source,
                                               const JsonLimits& limits);
void appendCbor(const nlohmann::json& value, std::string& to);

/// Returns the *.json files of a folder by file name. Errors: NotFound if the folder cannot be read.
[[nodiscard]] Result<std::vector<std::filesystem::path>> documentsIn(const std::filesystem::path& folder);
/// Returns `error` with the code for a fault in a file, or in a caller's argument.
[[nodiscard]] inline Error asParseError(Error error) { return {ErrorCode::ParseError, std::move(error.message)}; }
[[nodiscard]] inline Error asInvalidArgument(Error error) {
    return {ErrorCode::InvalidArgument, std::move(error.message)};
}

/// `where` begins the message, such as "lab.json: limits[2]". Errors: ParseError if `value` is not an object.
[[nodiscard]] Result<void> expectObject(const nlohmann::json& value, std::string_view where);
/// Checks that `value` is an object with no keys other than `known`. Errors: ParseError naming the first unknown key
/// and the known keys.
[[nodiscard]] Result<void> onlyKeys(const nlohmann::json& value, std::span<const std::string_view> known,
                                    std::string_view where);
[[nodiscard]] inline Result<void> onlyKeys(const nlohmann::json& value, std::initializer_list<std::string_view> known,
                                           std::string_view where) {
    return onlyKeys(value, std::span(known.begin(), known.size()), where);
}

/// Replaces bytes that are not UTF-8 by U+FFFD, without exceptions. An `indent` of -1 gives one line; `ascii` escapes.
[[nodiscard]] std::string dumpJson(const nlohmann::json& value, int indent = -1, bool ascii = false);
/// Returns one line for a message, at most 60 characters, whatever the value is.
[[nodiscard]] std::string shownJson(const nlohmann::json& value);

// Read members that may be missing or of another type, so that rows of a damaged file can be read too.

/// Limits for one row of a session file: results and report items are large, and scripts store nested values.
inline constexpr JsonLimits kRowLimits{.bytes = 256'000'000, .depth = 64};

[[nodiscard]] std::string textOr(const nlohmann::json& object, const char* key);
/// Returns NaN if there is no number; NaN is written as null.
[[nodiscard]] double numberOr(const nlohmann::json& object, const char* key);
[[nodiscard]] double numberOr(const nlohmann::json& value);
[[nodiscard]] std::uint64_t countOr(const nlohmann::json& object, const char* key);
[[nodiscard]] bool flagOr(const nlohmann::json& object, const char* key);
[[nodiscard]] std::vector<std::string> textsOr(const nlohmann::json& object, const char* key);
/// Returns null for NaN and infinity.
[[nodiscard]] nlohmann::json numberOrNull(double value);
/// Returns the member `key`, or null if there is none.
[[nodiscard]] nlohmann::json valueOr(const nlohmann::json& object, const char* key);

}  // namespace tacto

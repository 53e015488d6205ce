#include "core/base/JsonText.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "core/base/LocaleFreeText.h"

template class nlohmann::basic_json<>;  // see Json.h

namespace tacto {

namespace {

using nlohmann::json;

/// Builds the value from the parts that the parser reports. A function that returns false stops the parser.
class Builder {
public:
    Builder(const JsonLimits& limits, bool finite) : depth_(limits.depth), values_(limits.values), finite_(finite) {}

    [[nodiscard]] const std::string& problem() const noexcept { return problem_; }
    /// Whether the text is malformed, at the byte wrongAt() (from 1).
    [[nodiscard]] bool isSyntax() const noexcept { return isSyntax_; }
    [[nodiscard]] std::size_t wrongAt() const noexcept { return wrongAt_; }
    [[nodiscard]] json take() { return std::move(root_); }

    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(json::number_integer_t value) { return add(value); }
    bool number_unsigned(json::number_unsigned_t value) { return add(value); }
    bool number_float(json::number_float_t value, const std::string& text) {
        if (std::isfinite(value) || !finite_) return add(value);
        return refuse(fmt::format("the number {} is out of range", text));
    }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(json::binary_t&) { return refuse("binary data are not JSON"); }
    bool start_object(std::size_t) { return open(json::object()); }
    bool start_array(std::size_t) { return open(json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }
    bool key(std::string& name) {
        if (within_.back()->contains(name)) return refuse(givenTwice("the key \"{}\" of one object", name));
        key_ = std::move(name);
        return true;
    }
    bool parse_error(std::size_t position, const std::string&, const json::exception& why) {
        constexpr int kOutOfRange = 406;  // the library's error number for a number outside the range of double
        isSyntax_ = true;
        wrongAt_ = position;
        return refuse(why.id == kOutOfRange ? ": a number is out of range" : " is not JSON");
    }

private:
    bool refuse(std::string why) {
        problem_ = std::move(why);
        return false;
    }
    template <class Value>
    bool add(Value&& value) {
        if (!counts()) return false;
        put(json(std::forward<Value>(value)));
        return true;
    }
    json& put(json value) {
        if (within_.empty()) return root_ = std::move(value);
        json& parent = *within_.back();
        if (parent.is_object()) return parent[key_] = std::move(value);
        parent.push_back(std::move(value));
        return parent.back();
    }
    bool counts() { return values_-- > 0 || refuse("it holds more values than are accepted"); }
    bool open(json empty) {
        if (!counts()) return false;
        if (within_.size() >= static_cast<std::size_t>(depth_)) {
            return refuse(fmt::format("it nests deeper than {} levels", depth_));
        }
        within_.push_back(&put(std::move(empty)));
        return true;
    }
    bool close() {
        within_.pop_back();
        return true;
    }

    const int depth_;
    std::size_t values_;  // how many more values are accepted
    const bool finite_;   // only finite numbers are accepted
    json root_;
    std::vector<json*> within_;  // innermost last; an element moves only if nothing is open inside its parent
    std::string key_;
    std::string problem_;
    bool isSyntax_ = false;
    std::size_t wrongAt_ = 0;
};

}  // namespace

Result<json> parseJson(std::string_view text, std::string_view source, const JsonLimits& limits) {
    if (text.size() > limits.bytes) {
        return fail(ErrorCode::ParseError, "{}: {} bytes; at most {} are accepted", source, text.size(), limits.bytes);
    }
    // The library treats a null byte as the end of the text.
    if (text.find('\0') != std::string_view::npos)
        return fail(ErrorCode::ParseError, "{}: a null byte is not JSON", source);
    Builder builder(limits, true);
    if (json::sax_parse(text.begin(), text.end(), &builder)) return builder.take();
    if (!builder.isSyntax()) return fail(ErrorCode::ParseError, "{}: {}", source, builder.problem());
    const auto upTo = text.substr(0, std::min(builder.wrongAt(), text.size()));
    return fail(ErrorCode::ParseError, "{}: line {}{}", source, 1 + std::count(upTo.begin(), upTo.end(), '\n'),
                builder.problem());
}

namespace {

/// Whether each item states its length. For a text without length the library calls itself for each part, which may
/// again have no length: the stack would overflow before this code counts a level.
bool statesAllLengths(std::string_view bytes) noexcept {
    for (std::size_t at = 0; at < bytes.size();) {
        const auto head = static_cast<unsigned char>(bytes[at++]);
        const unsigned kind = head >> 5U, info = head & 31U;
        if (info > 27) return false;
        std::uint64_t value = info;
        if (info >= 24) {
            const std::size_t more = std::size_t{1} << (info - 24);
            if (bytes.size() - at < more) return false;
            value = 0;
            for (std::size_t i = 0; i < more; ++i) value = value << 8U | static_cast<unsigned char>(bytes[at++]);
        }
        const bool isText = kind == 2 || kind == 3;
        if (isText && value > bytes.size() - at) return false;
        if (isText) at += static_cast<std::size_t>(value);
    }
    return true;
}

}  // namespace

Result<json> parseCbor(std::string_view bytes, std::string_view source, const JsonLimits& limits) {
    if (bytes.size() > limits.bytes)
        return fail(ErrorCode::ParseError, "{}: {} bytes; at most {} are accepted", source, bytes.size(), limits.bytes);
    if (!statesAllLengths(bytes)) return fail(ErrorCode::ParseError, "{}: it is not CBOR of stated lengths", source);
    Builder builder(limits, false);
    if (json::sax_parse(bytes.begin(), bytes.end(), &builder, json::input_format_t::cbor)) return builder.take();
    return fail(ErrorCode::ParseError, "{}: {}", source, builder.isSyntax() ? "it is not CBOR" : builder.problem());
}

void appendCbor(const json& value, std::string& to) { json::to_cbor(value, to); }

Result<std::vector<std::filesystem::path>> documentsIn(const std::filesystem::path& folder) {
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    if (error) return fail(ErrorCode::NotFound, "cannot read the folder {}: {}", folder.string(), error.message());
    std::ranges::sort(files);
    return files;
}

Result<void> expectObject(const json& value, std::string_view where) {
    if (value.is_object()) return {};
    return fail(ErrorCode::ParseError, "{}: {} stands where an object is expected", where, shownJson(value));
}

Result<void> onlyKeys(const json& value, std::span<const std::string_view> known, std::string_view where) {
    if (auto object = expectObject(value, where); !object) return object;
    for (const auto& [key, member] : value.items()) {
        if (std::find(known.begin(), known.end(), key) != known.end()) continue;
        return fail(ErrorCode::ParseError, "{}: \"{}\" is not a known key; accepted are {}", where, key,
                    fmt::join(known, ", "));
    }
    return {};
}

std::string dumpJson(const json& value, int indent, bool ascii) {
    return value.dump(indent, ' ', ascii, json::error_handler_t::replace);
}

std::string shownJson(const json& value) {
    constexpr std::size_t kMaxExcerpt = 60;
    std::string text = dumpJson(value);
    if (text.size() <= kMaxExcerpt) return text;
    std::size_t end = kMaxExcerpt - 3;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0U) == 0x80U) --end;  // cuts only between characters
    return text.substr(0, end) + "...";
}

namespace {

const nlohmann::json* find(const nlohmann::json& object, const char* key) {
    if (!object.is_object()) return nullptr;
    const auto found = object.find(key);
    return found == object.end() ? nullptr : &*found;
}

}  // namespace

std::string textOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

nlohmann::json numberOrNull(double value) {
    return std::isfinite(value) ? nlohmann::json(value) : nlohmann::json(nullptr);
}

double numberOr(const nlohmann::json& value) {
    return value.is_number() ? value.get<double>() : std::numeric_limits<double>::quiet_NaN();
}

double numberOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr ? numberOr(*found) : std::numeric_limits<double>::quiet_NaN();
}

std::uint64_t countOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr && found->is_number_unsigned() ? found->get<std::uint64_t>() : 0;
}

bool flagOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr && found->is_boolean() && found->get<bool>();
}

std::vector<std::string> textsOr(const nlohmann::json& object, const char* key) {
    std::vector<std::string> texts;
    const auto* found = find(object, key);
    if (found == nullptr || !found->is_array()) return texts;
    for (const auto& each : *found) texts.push_back(each.is_string() ? each.get<std::string>() : std::string());
    return texts;
}

nlohmann::json valueOr(const nlohmann::json& object, const char* key) {
    const auto* found = find(object, key);
    return found != nullptr ? *found : nlohmann::json();
}

}  // namespace tacto

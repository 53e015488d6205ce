// Reading a template from its text and from its file.
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/JsonText.h"
#include "drivers/hid_massager/MassagerTemplate.h"

namespace tacto::hid {

namespace {

using Json = nlohmann::json;

constexpr std::size_t kMaxList = 64;
constexpr std::size_t kMaxText = 2000;

/// Where in the file a message points.
struct Place {
    std::string_view file;
    std::string part;  // "fields[1]"

    template <class... Args>
    tl::unexpected<Error> refuse(fmt::format_string<Args...> text, Args&&... args) const {
        return fail(ErrorCode::ParseError, "{}: {}", name(), fmt::format(text, std::forward<Args>(args)...));
    }
    [[nodiscard]] std::string name() const { return fmt::format("{}{}{}", file, part.empty() ? "" : ": ", part); }
    [[nodiscard]] Place at(std::string_view name, std::size_t index) const {
        return {file, fmt::format("{}[{}]", name, index)};
    }
    [[nodiscard]] Place in(std::string_view name) const { return {file, std::string(name)}; }
};

Result<void> onlyKeys(const Json& object, std::initializer_list<std::string_view> known, const Place& place) {
    return tacto::onlyKeys(object, known, place.name());
}

const Json& member(const Json& object, const char* key) {
    static const Json absent;
    const auto found = object.find(key);
    return found == object.end() ? absent : *found;
}

Result<std::string> textOf(const Json& object, const char* key, const Place& place) {
    const auto* text = member(object, key).get_ptr<const std::string*>();
    if (text == nullptr || text->empty()) return place.refuse("\"{}\" must be a text", key);
    if (text->size() > kMaxText) return place.refuse("\"{}\" is longer than {} bytes", key, kMaxText);
    return *text;
}

Result<std::int64_t> wholeOf(const Json& object, const char* key, std::int64_t low, std::int64_t high,
                             std::optional<std::int64_t> absent, const Place& place) {
    const Json& value = member(object, key);
    if (value.is_null() && absent) return *absent;
    if (!value.is_number_integer()) return place.refuse("\"{}\" must be a whole number from {} to {}", key, low, high);
    if (value.is_number_unsigned() && value.get<std::uint64_t>() > static_cast<std::uint64_t>(INT64_MAX)) {
        return place.refuse("\"{}\" is {}; {} to {} are accepted", key, value.get<std::uint64_t>(), low, high);
    }
    const auto number = value.get<std::int64_t>();
    if (number < low || number > high) {
        return place.refuse("\"{}\" is {}; {} to {} are accepted", key, number, low, high);
    }
    return number;
}

Result<Seconds> secondsOf(const Json& object, const char* key, const Place& place) {
    const Json& value = member(object, key);
    if (value.is_null()) return Seconds(0);
    if (!value.is_number()) return place.refuse("\"{}\" must be a number of seconds", key);
    const auto seconds = value.get<double>();
    if (!(std::isfinite(seconds) && seconds >= 0)) {
        return place.refuse("\"{}\" is {}; a finite number of 0 or more is accepted", key, seconds);
    }
    return Seconds(seconds);
}

/// Four hexadecimal digits, as USB identities are printed on the device and by lsusb.
Result<std::uint16_t> hex16Of(const Json& object, const char* key, const Place& place) {
    const auto text = textOf(object, key, place);
    if (!text) return failure(text);
    std::uint16_t value = 0;
    for (const char c : *text) {
        const auto digit = std::string_view("0123456789abcdef").find(static_cast<char>(c | 0x20));
        if (text->size() != 4 || digit == std::string_view::npos || (c >= 0x10 && c < 0x20)) {
            return place.refuse("\"{}\" is \"{}\"; four hexadecimal digits are accepted, as \"054C\"", key, *text);
        }
        value = static_cast<std::uint16_t>(value << 4 | static_cast<std::uint16_t>(digit));
    }
    return value;
}

/// "02 03 00": bytes of two hexadecimal digits with a space between.
Result<std::vector<std::uint8_t>> bytesOf(const Json& object, const char* key, const Place& place) {
    const auto text = textOf(object, key, place);
    if (!text) return failure(text);
    std::vector<std::uint8_t> bytes;
    constexpr std::string_view kDigits = "0123456789ABCDEF";
    for (std::size_t i = 0; i < text->size(); i += 3) {
        const auto upper = [&](std::size_t at) {
            const char c = at < text->size() ? (*text)[at] : ' ';
            return kDigits.find(c >= 'a' && c <= 'f' ? static_cast<char>(c - 'a' + 'A') : c);
        };
        const auto high = upper(i);
        const auto low = upper(i + 1);
        const bool spaced = i + 2 >= text->size() || ((*text)[i + 2] == ' ' && i + 3 < text->size());
        if (high == std::string_view::npos || low == std::string_view::npos || !spaced) {
            return place.refuse("\"{}\" is \"{}\"; bytes as \"02 03 FF\" are accepted", key, *text);
        }
        bytes.push_back(static_cast<std::uint8_t>(high << 4 | low));
    }
    return bytes;
}

/// A list of 1 (or `least`) to 64 entries, each read by `read(entry, place)`.
template <class T, class Read>
Result<std::vector<T>> listOf(const Json& object, const char* key, std::size_t least, const Place& place, Read read) {
    const Json& list = member(object, key);
    std::vector<T> all;
    if (list.is_null() && least == 0) return all;
    if (!list.is_array() || list.size() < least || list.size() > kMaxList) {
        return place.refuse("\"{}\" must be a list of {} to {} entries", key, least, kMaxList);
    }
    for (std::size_t i = 0; i < list.size(); ++i) {
        auto entry = read(list[i], place.at(key, i));
        if (!entry) return failure(entry);
        all.push_back(std::move(*entry));
    }
    return all;
}

Result<TemplateDevice> readDevice(const Json& json, const Place& place) {
    if (auto keys = onlyKeys(json, {"vendor", "product", "name"}, place); !keys) return failure(keys);
    const auto vendor = hex16Of(json, "vendor", place);
    if (!vendor) return failure(vendor);
    const auto product = hex16Of(json, "product", place);
    if (!product) return failure(product);
    auto name = textOf(json, "name", place);
    if (!name) return failure(name);
    return TemplateDevice{*vendor, *product, std::move(*name)};
}

Result<MassagerTemplate::Constant> readConstant(const Json& json, const Place& place) {
    if (auto keys = onlyKeys(json, {"byte", "hex"}, place); !keys) return failure(keys);
    const auto byte = wholeOf(json, "byte", 1, static_cast<std::int64_t>(kMaxReport), std::nullopt, place);
    if (!byte) return failure(byte);
    auto bytes = bytesOf(json, "hex", place);
    if (!bytes) return failure(bytes);
    return MassagerTemplate::Constant{static_cast<std::size_t>(*byte), std::move(*bytes)};
}

Result<ReportField> readField(const Json& json, const Place& place) {
    if (auto keys = onlyKeys(json, {"role", "byte", "bit", "bits", "endian", "min", "max"}, place); !keys) {
        return failure(keys);
    }
    ReportField field;
    const auto role = textOf(json, "role", place);
    if (!role) return failure(role);
    bool known = false;
    for (const auto one : {VibrationRole::Intensity, VibrationRole::Weak, VibrationRole::Strong}) {
        if (*role != nameOf(one)) continue;
        field.role = one;
        known = true;
    }
    if (!known) return place.refuse("\"role\" is \"{}\"; intensity, weak and strong are accepted", *role);
    const auto byte = wholeOf(json, "byte", 1, static_cast<std::int64_t>(kMaxReport), std::nullopt, place);
    if (!byte) return failure(byte);
    const auto bit = wholeOf(json, "bit", 0, 7, 0, place);
    if (!bit) return failure(bit);
    field.bit = static_cast<std::uint32_t>(*byte * 8 + *bit);
    const auto bits = wholeOf(json, "bits", 1, 32, 8, place);
    if (!bits) return failure(bits);
    field.bits = static_cast<std::uint8_t>(*bits);
    const auto order = member(json, "endian").is_null() ? Result<std::string>("little") : textOf(json, "endian", place);
    if (!order) return failure(order);
    if (*order != "little" && *order != "big") {
        return place.refuse("\"endian\" is \"{}\"; little and big are accepted", *order);
    }
    field.order = *order == "big" ? ByteOrder::Big : ByteOrder::Little;
    constexpr std::int64_t kFar = std::int64_t{1} << 32;
    const auto min = wholeOf(json, "min", -kFar, kFar, 0, place);
    if (!min) return failure(min);
    const auto max = wholeOf(json, "max", -kFar, kFar, std::nullopt, place);
    if (!max) return failure(max);
    field.min = *min;
    field.max = *max;
    return field;
}

Result<void> readReport(const Json& json, MassagerTemplate& into, const Place& place) {
    if (auto keys = onlyKeys(json, {"number", "lengths", "constants"}, place); !keys) return keys;
    const auto number = wholeOf(json, "number", 0, 255, std::nullopt, place);
    if (!number) return failure(number);
    into.report = static_cast<std::uint8_t>(*number);
    auto lengths = listOf<std::size_t>(json, "lengths", 1, place, [](const Json& entry, const Place& at) {
        const Json wrapped{{"length", entry}};
        return wholeOf(wrapped, "length", 2, static_cast<std::int64_t>(kMaxReport), std::nullopt, at)
            .map([](std::int64_t length) { return static_cast<std::size_t>(length); });
    });
    if (!lengths) return failure(lengths);
    into.lengths = std::move(*lengths);
    auto constants = listOf<MassagerTemplate::Constant>(json, "constants", 0, place, readConstant);
    if (!constants) return failure(constants);
    into.constants = std::move(*constants);
    return {};
}

Result<void> readStop(const Json& json, MassagerTemplate& into, const Place& place) {
    if (auto keys = onlyKeys(json, {"fields", "hex"}, place); !keys) return keys;
    if (json.size() != 1) return place.refuse("\"fields\": 0 or \"hex\" is accepted, one of them");
    if (json.contains("hex")) {
        auto bytes = bytesOf(json, "hex", place);
        if (!bytes) return failure(bytes);
        into.stop = std::move(*bytes);
        return {};
    }
    if (auto zero = wholeOf(json, "fields", 0, 0, std::nullopt, place); !zero) return failure(zero);
    return {};
}

Result<void> readUsage(const Json& json, MassagerTemplate& into, const Place& place) {
    if (json.is_null()) return {};
    if (auto keys = onlyKeys(json, {"page", "id"}, place); !keys) return keys;
    const auto page = hex16Of(json, "page", place);
    if (!page) return failure(page);
    const auto id = hex16Of(json, "id", place);
    if (!id) return failure(id);
    into.usage = usageOf(*page, *id);
    return {};
}

}  // namespace

Result<MassagerTemplate> parseMassagerTemplate(std::string_view text, std::string_view file) {
    const Place place{file, {}};
    const auto read = parseJson(text, file, {.bytes = kMaxTemplate});
    if (!read) return failure(read);
    const Json& json = *read;
    if (auto keys = onlyKeys(
            json,
            {"title", "source", "devices", "usage", "report", "fields", "stop", "keep_alive_s", "shortest_write_s"},
            place);
        !keys) {
        return failure(keys);
    }
    MassagerTemplate made;
    made.key = std::filesystem::path(file).stem().string();
    auto title = textOf(json, "title", place);
    if (!title) return failure(title);
    made.title = std::move(*title);
    auto source = textOf(json, "source", place);
    if (!source) return failure(source);
    made.source = std::move(*source);
    auto devices = listOf<TemplateDevice>(json, "devices", 1, place, readDevice);
    if (!devices) return failure(devices);
    made.devices = std::move(*devices);
    if (auto usage = readUsage(member(json, "usage"), made, place.in("usage")); !usage) return failure(usage);
    if (auto report = readReport(member(json, "report"), made, place.in("report")); !report) return failure(report);
    auto fields = listOf<ReportField>(json, "fields", 1, place, readField);
    if (!fields) return failure(fields);
    made.fields = std::move(*fields);
    if (auto stop = readStop(member(json, "stop"), made, place.in("stop")); !stop) return failure(stop);
    const auto keepAlive = secondsOf(json, "keep_alive_s", place);
    if (!keepAlive) return failure(keepAlive);
    made.keepAlive = *keepAlive;
    const auto shortest = secondsOf(json, "shortest_write_s", place);
    if (!shortest) return failure(shortest);
    made.shortestWrite = *shortest;
    for (const auto length : made.lengths) {
        if (const auto fits = made.reports(length); !fits) return place.refuse("{}", fits.error().message);
    }
    return made;
}

Result<MassagerTemplate> loadMassagerTemplate(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    if (!in)
        return fail(ErrorCode::NotFound, "no massager template {}; a file as resources/massagers/*.json is expected",
                    file.string());
    std::string text(kMaxTemplate + 1, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    if (in.bad() || (text.empty() && !in.eof())) return fail(ErrorCode::Io, "cannot read {}", file.string());
    return parseMassagerTemplate(text, file.string());
}

Result<std::vector<MassagerTemplate>> loadMassagerTemplates(const std::filesystem::path& folder) {
    std::error_code error;
    std::vector<std::filesystem::path> files;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        if (entry->path().extension() == ".json") files.push_back(entry->path());
    }
    if (error) {
        return fail(ErrorCode::NotFound, "no folder {} with massager templates: {}", folder.string(), error.message());
    }
    std::ranges::sort(files);
    std::vector<MassagerTemplate> all;
    for (const auto& file : files) {
        auto one = loadMassagerTemplate(file);
        if (!one) return failure(one);
        for (const auto& device : one->devices) {
            const auto same = std::ranges::find_if(all, [&](const MassagerTemplate& other) {
                return other.deviceOf(device.vendor, device.product) != nullptr;
            });
            if (same == all.end()) continue;
            return fail(ErrorCode::ParseError, "{}: device {:04x}:{:04x} is described by {} too; one is accepted",
                        file.string(), device.vendor, device.product, same->key);
        }
        all.push_back(std::move(*one));
    }
    return all;
}

}  // namespace tacto::hid

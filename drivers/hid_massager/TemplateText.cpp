// Reads a template from its text or its file.
#include <algorithm>

#include "core/base/Csv.h"
#include "core/base/LocaleFreeText.h"
#include "core/base/RecordFields.h"
#include "drivers/hid_massager/MassagerTemplate.h"

namespace tacto::hid {

namespace {

using nlohmann::json;

constexpr std::size_t kMaxList = 64;
constexpr AcceptedText kTemplateText{.mostBytes = 2000};
constexpr Word<ByteOrder> kByteOrders[] = {{"little", ByteOrder::Little}, {"big", ByteOrder::Big}};

template <class T>
std::optional<T> hexIn(std::string_view text) {
    return text.size() == 2 * sizeof(T) ? parseWhole<T>(text, 16) : std::nullopt;
}

/// Four hexadecimal digits, as printed on the device and by lsusb.
ValueKind<std::uint16_t> hex16Kind() {
    return codedKind<std::uint16_t>(
        "a text of four hexadecimal digits, as \"054C\",",
        [](const json& value) {
            return value.is_string() ? hexIn<std::uint16_t>(value.get<std::string>()) : std::nullopt;
        },
        [](const std::uint16_t& value) { return json(fmt::format("{:04X}", value)); });
}

ValueKind<std::vector<std::uint8_t>> bytesKind() {
    using Bytes = std::vector<std::uint8_t>;
    return codedKind<Bytes>(
        "a text of bytes, as \"02 03 FF\",",
        [](const json& value) -> std::optional<Bytes> {
            const auto* text = value.get_ptr<const std::string*>();
            if (text == nullptr || text->size() > kTemplateText.mostBytes) return std::nullopt;
            Bytes bytes;
            for (const auto part : split(*text, ' ')) {
                const auto byte = hexIn<std::uint8_t>(part);
                if (!byte) return std::nullopt;
                bytes.push_back(*byte);
            }
            return bytes;
        },
        [](const Bytes& bytes) { return json(fmt::format("{:02X}", fmt::join(bytes, " "))); });
}

// The parts of a template as a file stores them.
struct StoredUsage {
    std::uint16_t page = 0, id = 0;
};
struct StoredField {
    VibrationRole role = VibrationRole::Intensity;
    std::uint32_t byte = 0, bit = 0;
    std::uint8_t bits = 8;
    ByteOrder order = ByteOrder::Little;
    std::int64_t min = 0, max = 0;
};
struct StoredStop {
    std::optional<int> fields;
    std::optional<std::vector<std::uint8_t>> hex;
};

ValueKind<Usage> usageKind() {
    RecordFields<StoredUsage> stored;
    stored.add("page", &StoredUsage::page, hex16Kind()).required = true;
    stored.add("id", &StoredUsage::id, hex16Kind()).required = true;
    return storedAs<Usage, StoredUsage>(
        stored, [](const StoredUsage& usage) { return usageOf(usage.page, usage.id); },
        [](const Usage& usage) {
            return StoredUsage{pageOf(usage), idOf(usage)};
        });
}

ValueKind<ReportField> fieldKind() {
    constexpr double kMaxFieldValue = 4294967296;  // 2^32
    using F = StoredField;
    RecordFields<F> stored;
    stored.word("role", &F::role, kVibrationRoles).required = true;
    stored.number("byte", &F::byte, {.low = 1, .high = kMaxReport}).required = true;
    stored.number("bit", &F::bit, {.low = 0, .high = 7});
    stored.number("bits", &F::bits, {.low = 1, .high = 32});
    stored.word("endian", &F::order, kByteOrders);
    stored.number("min", &F::min, {.low = -kMaxFieldValue, .high = kMaxFieldValue});
    stored.number("max", &F::max, {.low = -kMaxFieldValue, .high = kMaxFieldValue}).required = true;
    return storedAs<ReportField, F>(
        stored,
        [](const F& field) {
            return ReportField{field.byte * 8 + field.bit, field.bits, field.order, field.min, field.max, field.role};
        },
        [](const ReportField& field) {
            return F{field.role, field.bit / 8, field.bit % 8, field.bits, field.order, field.min, field.max};
        });
}

/// Reads {"fields": 0}, which means the start report with all fields 0, or {"hex": "..."}.
ValueKind<MassagerTemplate> stopKind() {
    RecordFields<StoredStop> stored;
    stored.number("fields", &StoredStop::fields, {.low = 0, .high = 0}).leftOutIfEmpty = true;
    stored.add("hex", &StoredStop::hex, bytesKind()).leftOutIfEmpty = true;
    stored.rule([](const StoredStop& stop) -> Result<void> {
        if (stop.fields.has_value() != stop.hex.has_value()) return {};
        return fail(ErrorCode::ParseError, "\"fields\": 0 or \"hex\" is accepted, one of them");
    });
    ValueKind<MassagerTemplate> kind;
    kind.info = stored.kind().info;
    kind.reads([stored](const json& value, MassagerTemplate& into, const RecordPlace& place,
                        std::string_view key) -> Result<void> {
        auto stop = stored.read(value, place.in(key));
        if (!stop) return failure(stop);
        into.stop = std::move(stop->hex);
        return {};
    });
    kind.writes([stored](const MassagerTemplate& from) {
        return stored.write({from.stop ? std::nullopt : std::optional(0), from.stop});
    });
    return kind;
}

RecordFields<MassagerTemplate> templateFields() {
    using T = MassagerTemplate;
    RecordFields<TemplateDevice> device;
    device.add("vendor", &TemplateDevice::vendor, hex16Kind()).required = true;
    device.add("product", &TemplateDevice::product, hex16Kind()).required = true;
    device.text("name", &TemplateDevice::name, kTemplateText).required = true;

    RecordFields<T::Constant> constant;
    constant.number("byte", &T::Constant::byte, {.low = 1, .high = kMaxReport}).required = true;
    constant.add("hex", &T::Constant::value, bytesKind()).required = true;

    RecordFields<T> report;
    report.number("number", &T::report, {.low = 0, .high = 255}).required = true;
    const auto lengthKind = numberKind<std::size_t>({.low = 2, .high = kMaxReport});
    report.list("lengths", &T::lengths, lengthKind, 1, kMaxList).required = true;
    report.list("constants", &T::constants, constant.kind(), 0, kMaxList);

    RecordFields<T> all;
    all.text("title", &T::title, kTemplateText).required = true;
    all.text("source", &T::source, kTemplateText).required = true;
    all.list("devices", &T::devices, device.kind(), 1, kMaxList).required = true;
    all.add("usage", &T::usage, usageKind());
    all.record("report", std::identity{}, report).required = true;
    all.list("fields", &T::fields, fieldKind(), 1, kMaxList).required = true;
    all.add("stop", std::identity{}, stopKind()).required = true;
    all.number("keep_alive_s", &T::keepAlive, {.low = 0, .unit = "s"});
    all.number("shortest_write_s", &T::shortestWrite, {.low = 0, .unit = "s"});
    all.rule([](const T& made) -> Result<void> {
        for (const auto length : made.lengths) {
            if (const auto fits = made.reports(length); !fits) return failure(fits);
        }
        return {};
    });
    return all;
}

}  // namespace

Result<MassagerTemplate> parseMassagerTemplate(std::string_view text, std::string_view file) {
    auto made = parseRecord(builtOnce<templateFields>(), text, file, {.bytes = kMaxTemplate});
    if (made) made->key = std::filesystem::path(file).stem().string();
    return made;
}

Result<MassagerTemplate> loadMassagerTemplate(const std::filesystem::path& file) {
    const auto text = readTextFile(file, kMaxTemplate);
    if (!text) return failure(text);
    return parseMassagerTemplate(*text, file.string());
}

Result<std::vector<MassagerTemplate>> loadMassagerTemplates(const std::filesystem::path& folder) {
    const auto files = documentsIn(folder);
    if (!files) return failure(files);
    std::vector<MassagerTemplate> all;
    for (const auto& file : *files) {
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

#include "app/run/InstrumentPresets.h"

#include <algorithm>
#include <fmt/format.h>
#include <system_error>

#include "core/base/Csv.h"
#include "core/base/JsonText.h"
#include "core/base/RecordFields.h"
#include "core/base/WholeFile.h"
#include "core/calibration/CalibrationStore.h"
#include "core/devices/DeviceUri.h"

namespace tacto {

namespace {

constexpr AcceptedNumbers kPercent{.low = 0, .high = 50, .unit = "%"};

RecordFields<InstrumentPreset> presetFields() {
    using P = InstrumentPreset;
    RecordFields<P> fields;
    fields.word("kind", &P::kind, Words<InstrumentKind>(kInstrumentKinds)).required = true;
    fields.text("name", &P::name, {.mostBytes = 100}).required = true;
    fields.text("serial", &P::serial, {.mayBeEmpty = true, .mostBytes = 100});
    fields.text("address", &P::address, {.mayBeEmpty = true, .mostBytes = 500});
    fields.number("ohms", &P::ohms, {.low = 0, .high = 1e6, .openLow = true, .unit = "ohm"}).leftOutIfEmpty = true;
    fields.number("accuracy_pct", &P::accuracy_pct, kPercent).leftOutIfEmpty = true;
    fields.number("timebase_ppm", &P::timeBase_ppm, {.low = 0, .high = 1e5, .unit = "ppm"}).leftOutIfEmpty = true;
    fields.add("due", &P::due, dateKind()).leftOutIfEmpty = true;
    fields.passOverUnknownKeys();  // a later version may have more keys
    return fields;
}

struct PresetFile {
    std::vector<InstrumentPreset> instruments;
};

RecordFields<PresetFile> fileFields() {
    RecordFields<PresetFile> all;
    all.list("instruments", &PresetFile::instruments, presetFields().kind(), 0, 1000).required = true;
    all.passOverUnknownKeys();
    return all;
}

std::string shownName(const InstrumentPreset& preset) { return fmt::format("{} {}", nameOf(preset.kind), preset.name); }

Result<void> checkAddress(const InstrumentPreset& preset) {
    if (preset.kind != InstrumentKind::Oscilloscope) {
        if (preset.address.empty()) return {};
        return fail(ErrorCode::InvalidArgument, "{}: its address is \"{}\"; none is expected", shownName(preset),
                    preset.address);
    }
    auto uri = DeviceUri::parse(preset.address);
    if (!uri) return failure(uri);
    const auto stated =
        std::ranges::find_if(uri->parameters, [](const auto& one) { return statesAccuracy(one.first); });
    if (stated == uri->parameters.end()) return {};
    return fail(ErrorCode::InvalidArgument,
                "{}: its address states {}; figures are expected in their own fields, so that they end with the "
                "certificate",
                shownName(preset), stated->first);
}

}  // namespace

Result<void> check(const InstrumentPreset& preset) {
    if (auto sound = presetFields().check(preset, {}); !sound) return sound;
    if (auto sound = checkAddress(preset); !sound) return sound;
    if ((preset.kind == InstrumentKind::Shunt) != preset.ohms.has_value()) {
        return fail(ErrorCode::InvalidArgument, "{}: its resistance is {}; {} is expected", shownName(preset),
                    preset.ohms ? fmt::format("{:g} ohm", *preset.ohms) : "missing",
                    preset.kind == InstrumentKind::Shunt ? "a number above 0 to 1000000 ohm" : "none");
    }
    if (preset.timeBase_ppm && preset.kind != InstrumentKind::Oscilloscope) {
        return fail(ErrorCode::InvalidArgument, "{}: its time base is {:g} ppm; none is expected", shownName(preset),
                    *preset.timeBase_ppm);
    }
    return {};
}

ComposedAddress composed(const ChosenInstruments& chosen, CalibrationDate today) {
    ComposedAddress out;
    if (!chosen.oscilloscope) return out;
    out.text = chosen.oscilloscope->address;
    bool first = out.text.find('?') == std::string::npos;
    const auto add = [&](std::string_view key, const std::string& value) {
        out.text += fmt::format("{}{}={}", std::exchange(first, false) ? '?' : '&', key, value);
    };
    // A simulated oscilloscope and capture files are not read through a shunt.
    if (chosen.shunt && out.text.starts_with("sigrok:")) add("shunt", fmt::format("{:g}ohm", *chosen.shunt->ohms));
    const auto state = [&](const std::optional<InstrumentPreset>& one, std::string_view kind, std::string_view key,
                           std::optional<double> InstrumentPreset::*figure, std::string_view what,
                           std::string_view leaves) {
        if (!one) return out.said.push_back(fmt::format("No {} is chosen: {}.", kind, leaves));
        if (one->expired(today)) {
            return out.said.push_back(
                fmt::format("The certificate of the {} expired on {}: its {} is not used, and {}.", shownName(*one),
                            dateText(*one->due), what, leaves));
        }
        if (!((*one).*figure))
            return out.said.push_back(fmt::format("The {} does not state its {}: {}.", shownName(*one), what, leaves));
        add(key, fmt::format("{:g}", *((*one).*figure)));
    };
    using P = InstrumentPreset;
    constexpr std::string_view kSheet =
        "it is unknown unless a data sheet that the program has, or a certificate, states it";
    state(chosen.oscilloscope, "oscilloscope", "gain_pct", &P::accuracy_pct, "gain", kSheet);
    state(chosen.oscilloscope, "oscilloscope", "timebase_ppm", &P::timeBase_ppm, "time base", kSheet);
    state(chosen.shunt, "shunt", "shunt_pct", &P::accuracy_pct, "tolerance", "currents have no uncertainty");
    state(chosen.probe, "probe", "probe_pct", &P::accuracy_pct, "tolerance", "voltages have no uncertainty");
    return out;
}

Result<InstrumentPresets> InstrumentPresets::open(std::filesystem::path file) {
    InstrumentPresets presets(std::move(file));
    std::error_code error;
    if (!std::filesystem::exists(presets.file_, error)) return presets;
    const auto text = readTextFile(presets.file_);
    if (!text) return failure(text);
    const auto name = presets.file_.string();
    const auto json = parseJson(*text, name);
    if (!json) return failure(json);
    auto read = builtOnce<fileFields>().read(*json, {.file = name});
    if (!read) return failure(read);
    for (const auto& one : read->instruments) {
        if (auto sound = check(one); !sound) return fail(ErrorCode::ParseError, "{}: {}", name, sound.error().message);
    }
    presets.all_ = std::move(read->instruments);
    return presets;
}

Result<void> InstrumentPresets::save(const InstrumentPreset& preset) {
    if (auto sound = check(preset); !sound) return sound;
    auto all = all_;
    const auto same = std::ranges::find_if(
        all, [&](const InstrumentPreset& one) { return one.kind == preset.kind && one.name == preset.name; });
    if (same == all.end())
        all.push_back(preset);
    else
        *same = preset;
    return write(std::move(all));
}

Result<void> InstrumentPresets::remove(InstrumentKind kind, std::string_view name) {
    auto all = all_;
    const auto gone =
        std::erase_if(all, [&](const InstrumentPreset& one) { return one.kind == kind && one.name == name; });
    if (gone == 0) return fail(ErrorCode::NotFound, "no {} of the name {} is saved", nameOf(kind), name);
    return write(std::move(all));
}

Result<void> InstrumentPresets::write(std::vector<InstrumentPreset> all) {
    std::error_code ignored;
    std::filesystem::create_directories(file_.parent_path(), ignored);
    const auto text = dumpJson(builtOnce<fileFields>().write({all}), 2) + "\n";
    if (const auto written = writeWholeFile(file_, text); !written)
        return fail(ErrorCode::Io, "{} is not saved: {}", file_.string(), written.error().message);
    all_ = std::move(all);
    return {};
}

std::filesystem::path instrumentFile() { return calibrationFile().parent_path() / "instruments.json"; }

}  // namespace tacto

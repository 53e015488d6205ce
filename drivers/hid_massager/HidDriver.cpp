#include "drivers/hid_massager/HidDriver.h"

#include <algorithm>
#include <fmt/ranges.h>
#include <tuple>

#include "core/base/LocaleFreeText.h"
#include "core/devices/DeviceUri.h"
#include "drivers/hid_massager/Haptics.h"
#include "drivers/hid_massager/HidMassager.h"
#include "drivers/hid_massager/HidapiBackend.h"
#include "drivers/hid_massager/MassagerTemplate.h"
#include "drivers/hid_massager/TrancePort.h"

namespace tacto::hid {

namespace {

/// What a URI asks for.
struct Wanted {
    DeviceUri uri;
    std::optional<std::uint16_t> vendor, product;
    std::string serial, templateName, at;
};

std::optional<std::uint16_t> hex16(std::string_view text) {
    return text.size() == 4 ? parseWhole<std::uint16_t>(text, 16) : std::nullopt;
}

Result<Wanted> readUri(const DeviceUri& uri) {
    Wanted wanted;
    wanted.uri = uri;
    if (!uri.path.empty()) {
        const std::string_view path = uri.path;
        wanted.vendor = hex16(path.substr(0, 4));
        wanted.product = path.size() == 9 && path[4] == ':' ? hex16(path.substr(5)) : std::nullopt;
        if (!wanted.vendor || !wanted.product) {
            return uri.refuse(ErrorCode::InvalidArgument,
                              "\"{}\" is not a vendor and product; two times four hexadecimal digits are accepted, as "
                              "hid:054c:0ce6",
                              uri.path);
        }
    }
    UriParameters from(uri);
    wanted.serial = from.text("serial").value_or("");
    wanted.at = from.text("at").value_or("");
    wanted.templateName = from.text("template").value_or("");
    if (const auto read = from.finish(); !read) return failure(read);
    return wanted;
}

/// A device that can be opened as a massager.
struct Candidate {
    std::string name;
    std::string serial;
    std::string label, obstacle;
    std::uint16_t vendor = 0, product = 0;
    std::optional<HidDeviceInfo> hid;
    const MassagerTemplate* byTemplate = nullptr;  // null: the device's Haptics page describes it
    std::optional<UsbDeviceInfo> usb;              // set only for a Trance Vibrator
    bool byPlace = false;                          // told apart by its place, as another has the same serial number

    [[nodiscard]] const std::string& place() const { return hid ? hid->path : usb->path; }
    template <class Info>
    void describe(const Info& info) {
        serial = info.serial;
        label = info.label();
        obstacle = info.obstacle();
        vendor = info.vendor;
        product = info.product;
    }
};

/// True if a URI can contain `serial`; otherwise the URI omits it, and the other parameters identify the device.
bool fitsIntoUri(const std::string& serial) {
    return !serial.empty() && serial.find_first_of("&=?") == std::string::npos;
}

/// Returns a URI that opens this device and no other.
std::string uriOf(const Candidate& one, const Wanted& wanted) {
    DeviceUri uri{"hid", fmt::format("{:04x}:{:04x}", one.vendor, one.product), {}};
    if (fitsIntoUri(one.serial)) uri.parameters.emplace_back("serial", one.serial);
    if (one.byPlace) uri.parameters.emplace_back("at", one.place());
    if (!wanted.templateName.empty()) uri.parameters.emplace_back("template", wanted.templateName);
    return uri.text();
}

void markTwins(std::vector<Candidate>& all) {
    const auto key = [](const Candidate& one) {
        return std::tuple(one.vendor, one.product, fitsIntoUri(one.serial) ? one.serial : std::string());
    };
    for (auto& one : all) {
        one.byPlace = std::ranges::count_if(all, [&](const auto& other) { return key(other) == key(one); }) > 1;
    }
}

class HidDriver final : public Driver {
public:
    explicit HidDriver(HidDriverParts parts) : parts_(std::move(parts)) {}

    std::string_view scheme() const noexcept override { return "hid"; }
    bool runsOnVirtualClock() const noexcept override { return false; }

    std::vector<DeviceIdentity> list() const override {
        // Lists the devices of the readable templates; open() reports a template that cannot be read.
        const auto templates = loadMassagerTemplates(parts_.templates).value_or(std::vector<MassagerTemplate>{});
        std::vector<DeviceIdentity> found;
        for (const auto& one : candidates(templates, nullptr)) {
            DeviceIdentity identity{uriOf(one, {}), Role::Massager, one.name, one.serial, {}, false};
            identity.obstacle = one.obstacle;
            found.push_back(std::move(identity));
        }
        return found;
    }

    Result<void> open(const DeviceUri& uri, const std::set<Role>& /*wanted*/, const OpenContext& context,
                      DeviceSet& into) override {
        const auto wanted = readUri(uri);
        if (!wanted) return failure(wanted);
        if (auto free = into.checkFree(Role::Massager, uri); !free) return free;
        auto templates = loadMassagerTemplates(parts_.templates);
        if (!templates) return failure(templates);
        std::optional<MassagerTemplate> named;
        if (!wanted->templateName.empty()) {
            auto found = templateOf(*wanted, *templates);
            if (!found) return failure(found);
            named = std::move(*found);
        }
        const auto chosen = choose(*wanted, candidates(*templates, named ? &*named : nullptr, &*wanted));
        if (!chosen) return failure(chosen);
        if (!chosen->obstacle.empty()) return uri.refuse(ErrorCode::Io, "{}", chosen->obstacle);
        DeviceIdentity identity{uriOf(*chosen, *wanted), Role::Massager, chosen->name, chosen->serial, {}, false};
        auto opened = chosen->usb ? openTrance(*chosen, std::move(identity), context.clock)
                                  : openHid(*chosen, std::move(identity), context.clock);
        if (!opened) return uri.refuse(opened.error());
        into.massager = std::move(*opened);
        return {};
    }

private:
    static Result<MassagerTemplate> templateOf(const Wanted& wanted, const std::vector<MassagerTemplate>& shipped) {
        if (wanted.templateName.ends_with(".json")) return loadMassagerTemplate(wanted.templateName);
        std::vector<std::string_view> names;
        for (const auto& one : shipped) {
            if (one.key == wanted.templateName) return one;
            names.push_back(one.key);
        }
        return wanted.uri.refuse(ErrorCode::NotFound, "there is no template \"{}\"; there are {}, or a file",
                                 wanted.templateName, fmt::join(names, ", "));
    }

    /// If `named` is set, it describes the device that `wanted` asks for, whatever the device's identity.
    std::vector<Candidate> candidates(const std::vector<MassagerTemplate>& templates, const MassagerTemplate* named,
                                      const Wanted* wanted = nullptr) const {
        std::vector<Candidate> found;
        for (auto& info : parts_.backend->devices()) {
            if (std::ranges::any_of(found, [&](const auto& one) { return one.hid->path == info.path; })) continue;
            if (wanted != nullptr && wanted->vendor &&
                (info.vendor != *wanted->vendor || info.product != *wanted->product)) {
                continue;
            }
            Candidate one;
            one.byTemplate = named;
            for (const auto& other : templates) {
                const auto* device = named == nullptr ? other.deviceOf(info.vendor, info.product) : nullptr;
                if (device == nullptr) continue;
                one.byTemplate = &other;
                one.name = device->name;
            }
            if (one.byTemplate != nullptr) {
                const auto usage = one.byTemplate->usage;
                if (usage && info.usage != 0 && *usage != info.usage) continue;  // another collection of this device
            } else {
                const auto descriptor = parts_.backend->descriptor(info);
                if (!descriptor) continue;
                const auto parsed = parseHidDescriptor(*descriptor);
                if (!parsed || !findHaptics(*parsed)) continue;
            }
            if (one.name.empty()) one.name = info.name.empty() ? "haptic device" : info.name;
            one.describe(info);
            one.hid = std::move(info);
            found.push_back(std::move(one));
        }
        addTrance(found, wanted);
        markTwins(found);
        return found;
    }

    void addTrance(std::vector<Candidate>& found, const Wanted* wanted) const {
        if (!parts_.usb) return;
        if (wanted != nullptr && wanted->vendor &&
            (*wanted->vendor != kTranceVendor || *wanted->product != kTranceProduct)) {
            return;  // a URI for another device does not start USB
        }
        const auto context = parts_.usb();
        if (!context) return;
        for (const auto& info : (*context)->devices()) {
            if (info.vendor != kTranceVendor || info.product != kTranceProduct) continue;
            Candidate one;
            one.name = "Trance Vibrator";
            one.describe(info);
            one.usb = info;
            found.push_back(std::move(one));
        }
    }

    static Result<Candidate> choose(const Wanted& wanted, std::vector<Candidate> found) {
        if (!wanted.serial.empty()) std::erase_if(found, [&](const auto& one) { return one.serial != wanted.serial; });
        if (!wanted.at.empty()) std::erase_if(found, [&](const auto& one) { return one.place() != wanted.at; });
        if (found.size() == 1) return std::move(found.front());
        if (found.empty()) {
            return wanted.uri.refuse(ErrorCode::NotFound,
                                     "no such vibration device is plugged in; one with a template or a haptic "
                                     "controller is expected");
        }
        std::vector<std::string> addresses;
        for (const auto& one : found) addresses.push_back(uriOf(one, wanted));
        return wanted.uri.refuseChoice(addresses);
    }

    Result<std::unique_ptr<Massager>> openHid(const Candidate& chosen, DeviceIdentity identity,
                                              const Clock& clock) const {
        const auto& backend = parts_.backend;
        const auto descriptor = backend->descriptor(*chosen.hid);
        if (!descriptor) return failure(descriptor);
        const auto parsed = parseHidDescriptor(*descriptor);
        if (!parsed) return fail(parsed.error().code, "{}: {}", chosen.label, parsed.error().message);
        auto reports = chosen.byTemplate != nullptr ? chosen.byTemplate->reportsFor(*parsed)
                                                    : readHaptics(*parsed, *backend, *chosen.hid);
        if (!reports) return fail(reports.error().code, "{}: {}", chosen.label, reports.error().message);
        // Each opening reads the descriptor again, because the same socket may hold another device by then.
        OpenPort again = [backend = backend, wanted = *chosen.hid, expected = *descriptor,
                          byPlace = chosen.byPlace]() -> Result<std::unique_ptr<HidPort>> {
            for (const auto& info : backend->devices()) {
                if (byPlace && info.path != wanted.path) continue;
                if (info.vendor != wanted.vendor || info.product != wanted.product || info.serial != wanted.serial ||
                    info.usage != wanted.usage) {
                    continue;
                }
                const auto now = backend->descriptor(info);
                if (!now || *now != expected) continue;
                return backend->open(info);
            }
            return fail(ErrorCode::NotFound, "{} is not plugged in", wanted.label());
        };
        auto opened = HidMassager::open(std::move(again), std::move(identity), std::move(*reports), clock);
        if (!opened) return failure(opened);
        return std::move(*opened);
    }

    static Result<VibrationReports> readHaptics(const HidDescriptor& descriptor, const HidBackend& backend,
                                                const HidDeviceInfo& info) {
        const auto controls = findHaptics(descriptor);
        if (!controls) return failure(controls);
        const auto port = backend.open(info);
        if (!port) return failure(port);
        std::vector<std::uint8_t> list(controls->listLength);
        list[0] = controls->listReport;
        const auto came = (*port)->feature(list);
        if (!came) return failure(came);
        list.resize(*came);
        return hapticReports(*controls, list);
    }

    Result<std::unique_ptr<Massager>> openTrance(const Candidate& chosen, DeviceIdentity identity,
                                                 const Clock& clock) const {
        OpenPort again = [usb = parts_.usb, wanted = *chosen.usb,
                          byPlace = chosen.byPlace]() -> Result<std::unique_ptr<HidPort>> {
            const auto context = usb();
            if (!context) return failure(context);
            const auto info = (*context)->find(wanted.identity(), byPlace ? wanted.path : std::string());
            if (!info) return failure(info);
            return TrancePort::open(*context, *info);
        };
        auto opened = HidMassager::open(std::move(again), std::move(identity), tranceReports(), clock);
        if (!opened) return failure(opened);
        return std::move(*opened);
    }

    const HidDriverParts parts_;
};

}  // namespace

HidDriverParts systemHid(std::filesystem::path templates, UsbProvider usb) {
    return {hidapiBackend(), std::move(templates), std::move(usb)};
}

std::unique_ptr<Driver> makeHidDriver(HidDriverParts parts) { return std::make_unique<HidDriver>(std::move(parts)); }

}  // namespace tacto::hid

// MassagerTemplate.h - a HID vibration device described in a file (resources/massagers/*.json), for devices whose
// report descriptor does not say how they vibrate. Schema and an example: resources/massagers/README.md.
//
// Thread-safety: parse and lookups are pure; loadMassagerTemplates() reads files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/hid_massager/HidDescriptor.h"
#include "drivers/hid_massager/VibrationReports.h"

namespace tacto::hid {

struct TemplateDevice {
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    std::string name;
};

struct MassagerTemplate {
    std::string key;  ///< the file's name without ".json": what a URI's `template=` names
    std::string title;
    std::string source;  ///< the source of its figures
    std::vector<TemplateDevice> devices;
    std::optional<Usage> usage;        ///< the top-level collection's usage; nothing: any that the device has
    std::uint8_t report = 0;           ///< number of the output report; 0 where the device has none
    std::vector<std::size_t> lengths;  ///< accepted, the number's byte included; the device's own descriptor chooses
    struct Constant {
        std::size_t byte = 0;
        std::vector<std::uint8_t> value;
    };
    std::vector<Constant> constants;
    std::vector<ReportField> fields;
    std::optional<std::vector<std::uint8_t>> stop;  ///< its first bytes, 0 behind; nothing: the start report, fields 0
    Seconds keepAlive{0};
    Seconds shortestWrite{0};

    [[nodiscard]] const TemplateDevice* deviceOf(std::uint16_t vendor, std::uint16_t product) const noexcept;
    /// The reports at this length. Errors: InvalidArgument naming the accepted lengths.
    [[nodiscard]] Result<VibrationReports> reports(std::size_t length) const;
    /// The reports as the device's own descriptor has them. Errors: Unsupported where it has no such report, or of
    /// another length: then this is not the device that the template describes.
    [[nodiscard]] Result<VibrationReports> reportsFor(const HidDescriptor& descriptor) const;
};

inline constexpr std::size_t kMaxTemplate = 65536;  ///< bytes

/// `file` names the text in messages, and the key is made of it. Errors: ParseError "FILE: place: what is wrong".
[[nodiscard]] Result<MassagerTemplate> parseMassagerTemplate(std::string_view text, std::string_view file);

/// Errors: NotFound, Io; as parseMassagerTemplate().
[[nodiscard]] Result<MassagerTemplate> loadMassagerTemplate(const std::filesystem::path& file);

/// Reads every *.json in the folder, by name. Errors: NotFound (the folder); as above; ParseError where two describe
/// the same device, as chance would then decide which one it gets.
[[nodiscard]] Result<std::vector<MassagerTemplate>> loadMassagerTemplates(const std::filesystem::path& folder);

}  // namespace tacto::hid

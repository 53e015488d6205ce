// MassagerTemplate.h - describes a HID vibration device from a file (resources/massagers/*.json), for devices that do
// not describe their vibration in the report descriptor. Schema and an example: resources/massagers/README.md.
//
// Thread-safety: any thread; loadMassagerTemplates() reads files, everything else is pure.
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
    std::string key;  ///< the file's name without ".json", used in a URI's `template=`
    std::string title;
    std::string source;  ///< where the template's figures come from
    std::vector<TemplateDevice> devices;
    std::optional<Usage> usage;        ///< usage of the top-level collection; empty: any
    std::uint8_t report = 0;           ///< number of the output report; 0 if the device has none
    std::vector<std::size_t> lengths;  ///< accepted report lengths in bytes, number included
    struct Constant {
        std::size_t byte = 0;
        std::vector<std::uint8_t> value;
    };
    std::vector<Constant> constants;
    std::vector<ReportField> fields;
    std::optional<std::vector<std::uint8_t>> stop;  ///< first bytes of the stop, then zeros; empty: start with fields 0
    Seconds keepAlive{0};
    Seconds shortestWrite{0};

    [[nodiscard]] const TemplateDevice* deviceOf(std::uint16_t vendor, std::uint16_t product) const noexcept;
    /// Returns the reports for this length. Errors: InvalidArgument naming the accepted lengths.
    [[nodiscard]] Result<VibrationReports> reports(std::size_t length) const;
    /// Returns the reports in the length that the device's descriptor states. Errors: Unsupported if the descriptor has
    /// no such report or another length: then this is not the device that the template describes.
    [[nodiscard]] Result<VibrationReports> reportsFor(const HidDescriptor& descriptor) const;
};

inline constexpr std::size_t kMaxTemplate = 65536;  ///< bytes

/// Parses a template; `file` appears in messages and gives the key. Errors: ParseError "FILE: place: what is wrong".
[[nodiscard]] Result<MassagerTemplate> parseMassagerTemplate(std::string_view text, std::string_view file);

/// Errors: NotFound, Io; as parseMassagerTemplate().
[[nodiscard]] Result<MassagerTemplate> loadMassagerTemplate(const std::filesystem::path& file);

/// Reads every *.json file in the folder, ordered by name. Errors: NotFound (the folder); as above; ParseError if two
/// templates describe the same device, as chance would then decide which one applies.
[[nodiscard]] Result<std::vector<MassagerTemplate>> loadMassagerTemplates(const std::filesystem::path& folder);

}  // namespace tacto::hid

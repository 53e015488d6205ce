// CertificateDetails.h - the texts of a calibration certificate that only people know: the laboratory, its customer,
// the item's history, who authorises it (ISO/IEC 17025:2017, 7.8.2.1). Kept as entered; no result depends on them. An
// empty text is an open line on the certificate.
//
// JSON files hold these texts: certificateDetailsFile() keeps the laboratory's own details; a file for one run holds
// those of an order and may override the others.
//
// Thread-safety: pure functions, except those that read files.
#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "core/base/Result.h"
#include "core/calibration/CalibrationStore.h"

namespace tacto {

/// Each detail is one line of at most kDetailLimit characters (Unicode code points).
struct CertificateDetails {
    std::string laboratory, address, place, authorisedBy, function;
    std::string number, customer, contact, make, model, serial, condition, received, issued;
    bool operator==(const CertificateDetails&) const = default;
};

inline constexpr std::size_t kDetailLimit = 200;

struct CertificateDetail {
    std::string_view key;    ///< the key in files
    std::string_view title;  ///< the title on the certificate
    std::string CertificateDetails::*member;
    bool ofLaboratory = false;  ///< true if entered once for all orders
    bool isDate = false;        ///< true for a date such as "2026-11-21"
};
/// The details in the order of the certificate.
inline constexpr std::array<CertificateDetail, 14> kCertificateDetails{
    {{"laboratory", "Laboratory", &CertificateDetails::laboratory, true},
     {"address", "Address", &CertificateDetails::address, true},
     {"place", "Place of calibration", &CertificateDetails::place, true},
     {"number", "Laboratory's number", &CertificateDetails::number},
     {"customer", "Customer", &CertificateDetails::customer},
     {"contact", "Contact", &CertificateDetails::contact},
     {"make", "Make", &CertificateDetails::make},
     {"model", "Model", &CertificateDetails::model},
     {"serial", "Serial number", &CertificateDetails::serial},
     {"condition", "Condition at receipt", &CertificateDetails::condition},
     {"received", "Received on", &CertificateDetails::received, false, true},
     {"issued", "Issued on", &CertificateDetails::issued, false, true},
     {"authorised_by", "Authorised by", &CertificateDetails::authorisedBy, true},
     {"function", "Function", &CertificateDetails::function, true}}};

/// $XDG_DATA_HOME/tactoscope/certificate-details.json, or ~/.local/share/tactoscope/certificate-details.json.
[[nodiscard]] std::filesystem::path certificateDetailsFile();

/// Returns the laboratory's stored details, overridden by those of the run's `file`; an empty `file` adds none.
/// Errors: NotFound if `file` is missing; Io; ParseError naming file and key for an invalid text or date, an unknown
/// key, or a key of an order among the laboratory's details; InvalidArgument for an item received after `today` (the
/// day of calibration) or a certificate issued before it.
[[nodiscard]] Result<CertificateDetails> certificateDetails(const std::filesystem::path& file, CalibrationDate today);

/// Keeps the laboratory's own details in certificateDetailsFile() and those of an order in `file`. Errors: as
/// certificateDetails(); nothing is written then.
[[nodiscard]] Result<void> keepCertificateDetails(const CertificateDetails& details, const std::filesystem::path& file,
                                                  CalibrationDate today);

/// Returns the details that are not empty, by their keys.
[[nodiscard]] nlohmann::json toJson(const CertificateDetails& details);

}  // namespace tacto

// CertificateDetails.h - what a calibration certificate says beside what the program knows: the laboratory, its
// customer, the item's history, who authorises it (ISO/IEC 17025:2017, 7.8.2.1). As they were entered; nothing is
// judged by them. What is empty is an open line on the certificate.
//
// They stand in JSON files of texts: the laboratory's own details are kept once, in certificateDetailsFile(), and an
// order's details in a file of that run, which may override the rest.
//
// Thread-safety: pure functions, but for reading files.
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
    std::string_view key;    ///< in files
    std::string_view title;  ///< its title on the certificate
    std::string CertificateDetails::*member;
    bool ofLaboratory = false;  ///< said once for every order
    bool isDate = false;        ///< "2026-11-21"
};
/// The details in the order of a certificate.
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

/// The laboratory's own, where they are kept, with those of the run's `file` over them; an empty `file` adds none.
/// Errors: NotFound where `file` is missing; Io; ParseError naming file and key for what is no such text or date, for a
/// key that is unknown, or that of an order among the laboratory's own; InvalidArgument for an item that was received
/// after `today`, the day of calibration, or a certificate issued before.
[[nodiscard]] Result<CertificateDetails> certificateDetails(const std::filesystem::path& file, CalibrationDate today);

/// The details that are not empty, by their keys.
[[nodiscard]] nlohmann::json toJson(const CertificateDetails& details);

}  // namespace tacto

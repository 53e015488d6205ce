// CertificatePages.h - the report of a stimulator's calibration as a certificate that a laboratory can sign, as ISO/IEC
// 17025:2017 requires in 7.8.2.1, 7.8.4.1 and 7.8.6.2.
//
// A certificate claims no more than was done. A value that was not measured says so; a missing entry is a ruled line; a
// value without a certificate is not traceable; a simulated bench says SIMULATED in the title and on every page.
//
// Thread-safety: the GUI thread.
#pragma once

#include <vector>

#include "app/report/ReportContent.h"

namespace tacto {

/// Returns why the report is not a certificate; an empty text if it is; nothing if no certificate was requested.
[[nodiscard]] std::optional<QString> whyNoCertificate(const ReportModel& model);
[[nodiscard]] inline bool isCertificate(const ReportModel& model) {
    const auto why = whyNoCertificate(model);
    return why && why->isEmpty();
}

[[nodiscard]] QString certificateTitle(const ReportModel& model);
/// Adds laboratory, customer, item, place, dates and conditions, before the statement of conformity.
void addCertificateItem(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);
/// Adds the basis of the statement of conformity, general remarks on the certificate, and who authorises it.
void addCertificateConformity(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);
/// Returns the method, deviations from it, and the references that make the values traceable.
[[nodiscard]] std::vector<ReportFact> certificateMethod(const ReportModel& model);
/// Adds the results as found and as left.
void addCertificateResults(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);

}  // namespace tacto

// CertificatePages.h - the report of a stimulator's calibration as a certificate that a laboratory can sign: what
// ISO/IEC 17025:2017 asks for in 7.8.2.1, 7.8.4.1 and 7.8.6.2.
//
// A certificate claims no more than was done: what was not measured says so, what was not entered is a ruled line, what
// rests on no certificate is not traceable, and a simulated bench says SIMULATED in the title and on every page.
//
// Thread-safety: the GUI thread.
#pragma once

#include <vector>

#include "app/report/ReportContent.h"

namespace tacto {

/// Why the report of `model` is not a certificate; empty where it is one. Nothing where no certificate was asked for.
[[nodiscard]] std::optional<QString> whyNoCertificate(const ReportModel& model);
[[nodiscard]] inline bool isCertificate(const ReportModel& model) {
    const auto why = whyNoCertificate(model);
    return why && why->isEmpty();
}

[[nodiscard]] QString certificateTitle(const ReportModel& model);
/// Laboratory, customer, item, place, days and conditions, before the statement of conformity.
void addCertificateItem(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);
/// The basis of the statement of conformity, what holds for the certificate, and who authorises it.
void addCertificateConformity(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);
/// The method, what was done otherwise, and what the values are traceable through.
[[nodiscard]] std::vector<ReportFact> certificateMethod(const ReportModel& model);
/// Adds the results as found and as left.
void addCertificateResults(const ReportModel& model, Captions& captions, std::vector<ReportBlock>& blocks);

}  // namespace tacto

#include "app/report/VerdictMark.h"

#include <map>

#include "app/report/Ink.h"
#include "app/report/ResultCells.h"

namespace tacto {
namespace {

const QColor kWhite(0xff, 0xff, 0xff);

}  // namespace

VerdictMark verdictMark(const QString& key) {
    struct Inks {
        QColor fill, ink, colour;
    };
    static const std::map<QString, Inks> kInks{{"pass", {ink::kPass, kWhite, ink::kPass}},
                                               {"fail", {ink::kFail, kWhite, ink::kText}},
                                               {"indeterminate", {ink::kAmberCell, ink::kAmberText, ink::kAmberText}},
                                               {"stopped", {ink::kSunken, ink::kText, ink::kQuiet}},
                                               {"attention", {ink::kAmberCell, ink::kAmberText, ink::kAmberText}},
                                               {"refused as expected", {ink::kAmberCell, ink::kAmberText, ink::kText}},
                                               {"not evaluated", {ink::kSunken, ink::kText, ink::kText}}};
    const auto found = kInks.find(key);
    const auto inks = found != kInks.end() ? found->second : Inks{ink::kSunken, ink::kText, ink::kQuiet};
    return {verdictShape(key), inks.fill, inks.ink, inks.colour};
}

VerdictMark verdictMark(ReportVerdict verdict) {
    switch (verdict) {
        case ReportVerdict::Pass:
            return verdictMark("pass");
        case ReportVerdict::Fail:
            return verdictMark("fail");
        case ReportVerdict::Indeterminate:
            return verdictMark("indeterminate");
        case ReportVerdict::Stopped:
            return verdictMark("stopped");
        case ReportVerdict::None:
            break;
    }
    return verdictMark(QString());
}

}  // namespace tacto

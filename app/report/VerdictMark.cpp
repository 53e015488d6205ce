#include "app/report/VerdictMark.h"

#include <map>

#include "app/report/Ink.h"

namespace tacto {
namespace {

const QColor kWhite(0xff, 0xff, 0xff);

const std::map<QString, VerdictMark>& verdictMarks() {
    static const std::map<QString, VerdictMark> marks{
        {"pass", {"✔", ink::kPass, kWhite, ink::kPass}},
        {"fail", {"✖", ink::kFail, kWhite, ink::kText}},
        {"indeterminate", {"?", ink::kAmberCell, ink::kAmberText, ink::kAmberText}},
        {"stopped", {"■", ink::kSunken, ink::kText, ink::kQuiet}},
        {"attention", {"▲", ink::kAmberCell, ink::kAmberText, ink::kAmberText}},
        {"refused as expected", {"⊘", ink::kAmberCell, ink::kAmberText, ink::kText}},
        {"not evaluated", {"○", ink::kSunken, ink::kText, ink::kText}},
        {"not applicable", {"–", ink::kSunken, ink::kText, ink::kQuiet}},
    };
    return marks;
}

}  // namespace

VerdictMark verdictMark(const QString& key) {
    const auto found = verdictMarks().find(key);
    return found != verdictMarks().end() ? found->second : VerdictMark{"–", ink::kSunken, ink::kText, ink::kQuiet};
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

QString verdictCell(const QString& key) {
    const auto found = verdictMarks().find(key);
    return found != verdictMarks().end() ? found->second.shape + QChar(0x00a0) + key : key;
}

}  // namespace tacto

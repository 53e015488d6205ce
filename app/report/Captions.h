// Captions.h - numbers the headings, figures and tables of a report, and marks the captions of what is simulated.
//
// Thread-safety: none; one report at a time.
#pragma once

#include "app/report/ReportContent.h"

namespace tacto {

class Captions {
public:
    explicit Captions(bool simulated = false) : simulated_(simulated) {}
    /// Whether the tables that follow are of what is simulated.
    void setSimulated(bool simulated) { simulated_ = simulated; }
    QString figure(const QString& text, bool simulated) { return numbered("Figure", ++figures_, text, simulated); }
    QString table(const QString& text) { return numbered("Table", ++tables_, text, simulated_); }
    HeadingBlock heading(const QString& text) { return {QString("%1  %2").arg(++headings_).arg(text)}; }

private:
    [[nodiscard]] QString numbered(const char* kind, int number, const QString& text, bool simulated) const {
        QString caption = QString("%1 %2. %3").arg(QLatin1String(kind)).arg(number).arg(text);
        if (simulated) caption += " (simulated)";
        return caption;
    }
    bool simulated_;
    int figures_ = 0;
    int tables_ = 0;
    int headings_ = 0;
};

}  // namespace tacto

// RecordSearch.h - goes from match to match of a trigger in the record that is shown: a file, or a capture on hold.
//
// Thread-safety: the GUI thread; the search itself runs on the pipe's thread.
#pragma once

#include <QObject>
#include <memory>
#include <vector>

#include "app/gui/scope/model/CapturePipe.h"
#include "app/gui/scope/model/ScopeModel.h"

namespace tacto::gui {

class RecordSearch final : public QObject {
    Q_OBJECT
public:
    /// Both arguments outlive this.
    RecordSearch(CapturePipe& pipe, ScopeModel& model) : pipe_(pipe), model_(model) {}
    /// Does nothing without a record. Goes to the next match (`step` 1) or the previous one (-1), from the one shown
    /// last or from the middle of the screen. Searches first if record, trigger or unit changed. said() follows.
    void go(int step, const SampleTrigger& trigger, const QString& unit);
    /// True if a match of the shown record is marked on the screen.
    [[nodiscard]] bool marks() const { return model_.trigger().moment_s().has_value() && shows(); }

signals:
    void said(const QString& what);

private:
    [[nodiscard]] bool shows() const { return model_.shown() && model_.shown()->capture == of_.lock(); }
    void found(int step, std::vector<double> places);
    void move(int step);

    CapturePipe& pipe_;
    ScopeModel& model_;
    std::weak_ptr<const Capture> of_;  ///< the searched record
    SampleTrigger trigger_;
    QString unit_;
    std::vector<double> places_;  ///< samples from the record's start
    std::ptrdiff_t at_ = -1;
    double left_s_ = 0;  ///< of the screen when it last moved; another one: the user moved it
};

}  // namespace tacto::gui

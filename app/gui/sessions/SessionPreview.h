// SessionPreview.h - the main plot of a session: its trials in the plane; without trials the first figure of its
// report; otherwise what was felt and delivered over time, with the operator's marks.
#pragma once

#include <QLabel>
#include <QStackedWidget>
#include <memory>
#include <qcustomplot.h>

#include "app/gui/sessions/ReadSession.h"
#include "app/gui/theme/MarkLines.h"

namespace tacto::gui {

class SheetView;
class TrialPlane;

/// Adds values over time, thinned to what is visible.
QCPGraph* addCurve(QCustomPlot& plot, QCPAxis* values, const std::vector<double>& t, const std::vector<double>& y,
                   const QString& name);

class SessionPreview final : public QWidget {
    Q_OBJECT
public:
    explicit SessionPreview(QWidget* parent = nullptr);
    void show(const ReadSession& session);
    void clear();
    /// Returns the title, such as "Trials in the plane" or a figure's caption; empty if nothing is shown.
    [[nodiscard]] QString title() const { return title_->text(); }
    /// Returns the operator's marks over time, as drawn now.
    [[nodiscard]] const MarkLines& marks() const { return *marks_; }

private:
    void drawCourse(const ReadSession& session);
    void drawMarks();
    void colour();
    QLabel* title_;
    QStackedWidget* stack_;
    QLabel* nothing_;
    TrialPlane* plane_;
    SheetView* sheet_;
    QCustomPlot* course_;
    QCPItemText* watermark_ = nullptr;
    std::vector<PlotMark> marked_;
    std::unique_ptr<MarkLines> marks_;
};

}  // namespace tacto::gui

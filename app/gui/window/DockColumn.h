// DockColumn.h - the docks at the right: open, or collapsed to a strip that keeps their names and key figures.
//
// Each workspace remembers which: live work shows the docks, everything else gives the room to its plot. A dock that
// floats never lies on the safety bar.
#pragma once

#include <QAction>
#include <QMainWindow>
#include <QToolBar>
#include <set>
#include <vector>

#include "app/gui/theme/Theme.h"
#include "app/gui/window/FoldingDock.h"

namespace tacto::gui {

class StripButton;

class DockColumn final : public QObject {
    Q_OBJECT
public:
    /// The docks belong to the window, and are listed from top to bottom.
    DockColumn(QMainWindow& window, std::vector<FoldingDock*> docks);
    /// The content beside the docks, and how these stand there at first.
    struct View {
        int workspace = 0;
        QString name;  ///< a workspace may have several
        bool open = false;
        std::vector<FoldingDock*> folded;
    };
    /// Shows the docks as this view was left, else as it says.
    void enter(const View& view);
    void setCollapsed(bool collapsed);
    [[nodiscard]] bool collapsed() const { return collapsed_; }
    [[nodiscard]] const std::vector<FoldingDock*>& docks() const { return docks_; }
    /// Opens the column with this dock unfolded; waits until the column is no longer hidden.
    void show(FoldingDock& dock);
    /// Puts the docks back as at the first start: in their places, open where work is live.
    void reset();
    /// Why neither docks nor strip are shown, floating docks included. Either is reason enough.
    enum class Hidden {
        PlotOnly,
        Blind,  ///< hidden while the operator is blind: it would tell what is delivered
    };
    void setHidden(Hidden why, bool hidden);
    /// The key figures, as often as telemetry is read.
    void refresh();
    /// Collapses and opens the column; has a key.
    [[nodiscard]] QAction* toggle() const { return toggle_; }

protected:
    bool eventFilter(QObject* watched, QEvent* event) override;

private:
    void apply();
    void leaveBar(FoldingDock& dock);
    void fitStrip();
    void fitWidth();
    void foldAsLeft();
    void share();

    QMainWindow& window_;
    std::vector<FoldingDock*> docks_;
    std::vector<StripButton*> buttons_;
    QToolBar* strip_;
    QWidget* bar_ = nullptr;  // the window's safety bar
    QAction* toggle_;
    View view_;
    bool entering_ = false;  // the view sets the folds, not the operator: they are not remembered
    bool collapsed_ = false;
    int width_ = scaledPx(FoldingDock::kWidth);  // the least width of the docks
    std::set<Hidden> hidden_;
    std::vector<FoldingDock*> putAway_;  // floating ones, hidden meanwhile
};

}  // namespace tacto::gui

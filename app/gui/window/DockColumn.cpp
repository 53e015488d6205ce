#include "app/gui/window/DockColumn.h"

#include <QPainter>
#include <QScreen>
#include <QSettings>
#include <QStyle>
#include <QTimer>
#include <QToolButton>
#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kStripIcon = 16;
constexpr int kStripGap = 8;

constexpr int kFewLines = 88;  ///< least height of a dock that makes room for those above: header and a button

QString settingOf(int workspace) { return QString("docks/collapsed%1").arg(workspace); }

constexpr std::size_t kFewRows = 3;  ///< of a list, in place of kFewLines

int leastOf(const FoldingDock& dock) {
    const auto rows = dock.rowEdges();
    const int few = rows.empty() ? scaledPx(kFewLines) : rows[std::min(kFewRows, rows.size()) - 1];
    return std::max(std::min(dock.wantedHeight(), few), dock.minimumSizeHint().height());
}

/// Returns how much of `height` shows only a part of a row.
int cutRow(const FoldingDock& dock, int height) {
    const auto rows = dock.rowEdges();
    const auto next = std::ranges::upper_bound(rows, height);
    return next == rows.begin() || next == rows.end() ? 0 : height - *std::prev(next);
}

QString settingOf(const QString& view, const FoldingDock& dock) {
    return QString("docks/folded-%1-%2").arg(view, dock.objectName());
}

}  // namespace

/// A button with a dock's icon and, if there is room, its name and key figure, written from top to bottom.
class StripButton final : public QToolButton {
public:
    StripButton(FoldingDock& dock, QWidget* parent) : QToolButton(parent), dock_(dock) {
        setFocusPolicy(Qt::TabFocus);
        setAccessibleName(dock.windowTitle());
        setToolTip(DockColumn::tr("Show %1").arg(dock.windowTitle()));
        refresh();
    }
    /// Returns true if the text has changed.
    bool refresh() {
        const auto figure = dock_.keyFigure();
        const auto text = figure.isEmpty() ? dock_.windowTitle() : dock_.windowTitle() + " · " + figure;
        if (std::exchange(text_, text) == text) return false;
        setAccessibleDescription(figure);
        updateGeometry();
        update();
        return true;
    }
    void setWorded(bool worded) {
        if (std::exchange(worded_, worded) != worded) updateGeometry();
    }
    [[nodiscard]] QSize sizeHint() const override {
        const int alone = iconSide() + 2 * kStripGap;
        if (!worded_) return {alone, alone};
        const QFontMetrics words(textFont(TextSize::Small));
        return {alone, alone + words.horizontalAdvance(text_) + 2 * kStripGap};
    }
    [[nodiscard]] QSize minimumSizeHint() const override { return sizeHint(); }

protected:
    void paintEvent(QPaintEvent* /*event*/) override {
        QPainter painter(this);
        const auto& c = colours();
        if (underMouse()) painter.fillRect(rect(), c.sunken);
        const int side = iconSide();
        painter.drawPixmap((width() - side) / 2, kStripGap,
                           iconPixmap(dock_.iconName(), c.text, side, devicePixelRatioF()));
        painter.setFont(textFont(TextSize::Small));
        painter.setPen(c.quiet);
        painter.translate(width(), side + 2 * kStripGap);
        painter.rotate(90);
        if (worded_)
            painter.drawText(QRect(0, 0, height() - side - 2 * kStripGap, width()), Qt::AlignLeft | Qt::AlignVCenter,
                             text_);
        painter.resetTransform();
        if (!hasFocus()) return;
        painter.setPen(QPen(c.text, 2));
        painter.drawRect(rect().adjusted(1, 1, -1, -1));
    }

private:
    [[nodiscard]] static int iconSide() { return scaledPx(kStripIcon); }

    FoldingDock& dock_;
    QString text_;
    bool worded_ = true;
};

DockColumn::DockColumn(QMainWindow& window, std::vector<FoldingDock*> docks)
    : QObject(&window), window_(window), docks_(std::move(docks)), strip_(new QToolBar(tr("Docks"), &window)) {
    toggle_ = new QAction(tr("&Docks"), this);
    toggle_->setCheckable(true);
    toggle_->setShortcut(QKeySequence(Qt::CTRL | Qt::Key_D));
    toggle_->setToolTip(tr("Opens the docks, or collapses them to a strip (Ctrl+D)"));
    connect(toggle_, &QAction::triggered, this, [this](bool open) { setCollapsed(!open); });
    strip_->setObjectName("dockStrip");
    strip_->setMovable(false);
    strip_->setFloatable(false);
    strip_->toggleViewAction()->setEnabled(false);
    strip_->setContextMenuPolicy(Qt::PreventContextMenu);
    auto* open = new QToolButton(strip_);
    open->setIcon(icon("expand"));
    open->setAccessibleName(tr("Open the docks"));
    open->setToolTip(tr("Opens the docks (Ctrl+D)"));
    connect(open, &QToolButton::clicked, this, [this] { setCollapsed(false); });
    strip_->addWidget(open);
    for (auto* dock : docks_) {
        window_.addDockWidget(Qt::RightDockWidgetArea, dock);
        dock->installEventFilter(this);
        auto* button = new StripButton(*dock, strip_);
        connect(button, &QToolButton::clicked, this, [this, dock] { show(*dock); });
        strip_->addWidget(button);
        buttons_.push_back(button);
        connect(dock, &FoldingDock::foldChanged, this, [this, dock] {
            if (entering_) return;
            QSettings().setValue(settingOf(view_.name, *dock), dock->folded());
            QTimer::singleShot(0, this, &DockColumn::share);
        });
        connect(dock, &FoldingDock::contentChanged, this, [this] { QTimer::singleShot(0, this, &DockColumn::share); });
    }
    window_.addToolBar(Qt::RightToolBarArea, strip_);
    window_.installEventFilter(this);
    bar_ = window_.findChild<QWidget*>("safetyBar");
    if (bar_ != nullptr) bar_->installEventFilter(this);
    strip_->installEventFilter(this);
    afterLookChange(*strip_, [this] {
        fitStrip();
        fitWidth();
    });
    apply();
}

void DockColumn::enter(const View& view) {
    view_ = view;
    collapsed_ = QSettings().value(settingOf(view.workspace), !view.open).toBool();
    foldAsLeft();
    apply();
}

void DockColumn::foldAsLeft() {
    entering_ = true;
    for (auto* dock : docks_) {
        const bool folded = std::ranges::find(view_.folded, dock) != view_.folded.end();
        dock->fold(QSettings().value(settingOf(view_.name, *dock), folded).toBool());
    }
    entering_ = false;
}

void DockColumn::setCollapsed(bool collapsed) {
    collapsed_ = collapsed;
    QSettings().setValue(settingOf(view_.workspace), collapsed);
    apply();
}

void DockColumn::show(FoldingDock& dock) {
    dock.fold(false);
    setCollapsed(false);
    if (!hidden_.empty()) return;
    dock.show();
    dock.raise();
}

void DockColumn::reset() {
    QSettings().remove("docks");
    for (auto* dock : docks_) {
        dock->setFloating(false);
        window_.addDockWidget(Qt::RightDockWidgetArea, dock);
    }
    foldAsLeft();
    const QList<QDockWidget*> all{docks_.begin(), docks_.end()};
    window_.resizeDocks(all, QList<int>(all.size(), scaledPx(FoldingDock::kWidth)), Qt::Horizontal);
    share();
}

void DockColumn::setHidden(Hidden why, bool hidden) {
    if (hidden)
        hidden_.insert(why);
    else
        hidden_.erase(why);
    for (auto* dock : docks_) {
        dock->toggleViewAction()->setEnabled(hidden_.empty());
        if (hidden_.empty() || !dock->isFloating() || !dock->isVisible()) continue;
        dock->hide();
        putAway_.push_back(dock);
    }
    if (hidden_.empty()) {
        for (auto* dock : std::exchange(putAway_, {})) dock->show();
    }
    apply();
}

void DockColumn::refresh() {
    if (!strip_->isVisible()) return;
    bool changed = false;
    for (auto* button : buttons_) changed = button->refresh() || changed;
    if (changed) fitStrip();
}

/// Shows icons without names, starting from the lowest button, until all buttons are in sight.
void DockColumn::fitStrip() {
    for (auto* button : buttons_) button->setWorded(true);
    for (auto button = buttons_.rbegin(); button != buttons_.rend(); ++button) {
        if (strip_->sizeHint().height() <= strip_->height()) return;
        (*button)->setWorded(false);
    }
}

/// After a change of text size, docks that had the smallest width get the new smallest width.
void DockColumn::fitWidth() {
    constexpr int kNarrow = 8;  // a dock wider by more than this was widened by the user
    const int before = std::exchange(width_, scaledPx(FoldingDock::kWidth));
    if (before == width_) return;
    QList<QDockWidget*> narrow;
    for (auto* dock : docks_)
        if (dock->isVisible() && !dock->isFloating() && dock->width() <= before + kNarrow) narrow << dock;
    window_.resizeDocks(narrow, QList<int>(narrow.size(), width_), Qt::Horizontal);
}

void DockColumn::apply() {
    for (auto* dock : docks_) {
        if (!dock->isFloating()) dock->setVisible(!collapsed_ && hidden_.empty());
    }
    strip_->setVisible(collapsed_ && hidden_.empty());
    toggle_->setChecked(!collapsed_);
    QTimer::singleShot(0, this, &DockColumn::share);  // after the docks are laid out
}

/// Each open dock first gets a few lines. Then the docks get what they want, the first one first; the last one also
/// gets the rest, or gives it to the one above if a row would be cut. If no dock is cut off, nothing changes.
void DockColumn::share() {
    QList<QDockWidget*> all;
    QList<int> heights;
    const int between = window_.style()->pixelMetric(QStyle::PM_DockWidgetSeparatorExtent, nullptr, &window_);
    // The height of the column, not of its docks: those may leave a part of it blank.
    int left = (window_.centralWidget() == nullptr ? 0 : window_.centralWidget()->height()) + between;
    bool cut = false;
    const FoldingDock* last = nullptr;
    for (auto* dock : docks_) {
        const bool here = window_.dockWidgetArea(dock) == Qt::RightDockWidgetArea && !dock->isFloating();
        if (!here || !dock->isVisible()) continue;
        all << dock;
        heights << (dock->folded() ? dock->maximumHeight() : leastOf(*dock));
        left -= heights.back() + between;
        if (dock->folded()) continue;
        last = dock;
        cut = cut || dock->height() < dock->wantedHeight();
    }
    if (!cut) return;
    std::optional<qsizetype> above;
    for (qsizetype i = 0; i < all.size(); ++i) {
        const auto* dock = static_cast<FoldingDock*>(all[i]);
        if (dock->folded()) continue;
        const int more = std::max(0, dock == last ? left : std::min(dock->wantedHeight() - heights[i], left));
        heights[i] += more;
        left -= more;
        if (dock == last && above) {
            const int part = cutRow(*dock, heights[i]);
            heights[i] -= part;
            heights[*above] += part;
        }
        above = i;
    }
    window_.resizeDocks(all, heights, Qt::Vertical);
}

/// Moves a floating dock that covers the safety bar: to below the bar, else above it, or back into the column if the
/// screen has no room.
void DockColumn::leaveBar(FoldingDock& dock) {
    if (bar_ == nullptr || !dock.isFloating() || !dock.isVisible() || !window_.isVisible()) return;
    const QRect kept(bar_->mapToGlobal(QPoint()), bar_->size()), at = dock.frameGeometry();
    if (!kept.intersects(at)) return;
    const auto screen = window_.screen()->availableGeometry();
    const int below = kept.bottom() + 1, above = kept.top() - at.height();
    if (below + at.height() > screen.bottom() + 1 && above < screen.top()) {
        const int room = screen.bottom() + 1 - below - (at.height() - dock.height());
        if (room < dock.minimumSizeHint().height()) return dock.setFloating(false);
        dock.resize(dock.width(), std::min(dock.height(), room));
    }
    const bool fits = below + dock.frameGeometry().height() <= screen.bottom() + 1;
    dock.move(at.left(), fits ? below : above);
}

bool DockColumn::eventFilter(QObject* watched, QEvent* event) {
    const bool moves =
        event->type() == QEvent::Move || event->type() == QEvent::Resize || event->type() == QEvent::Show;
    if (moves) {
        for (auto* dock : docks_)
            if (watched == dock || watched == &window_ || watched == bar_) leaveBar(*dock);
    }
    if (watched == &window_ && event->type() == QEvent::Resize) QTimer::singleShot(0, this, &DockColumn::share);
    if (watched == strip_ && event->type() == QEvent::Resize) fitStrip();
    return QObject::eventFilter(watched, event);
}

}  // namespace tacto::gui

#include "moc_DockColumn.cpp"

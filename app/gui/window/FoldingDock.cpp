#include "app/gui/window/FoldingDock.h"

#include <QApplication>
#include <QMouseEvent>
#include <QScrollArea>
#include <QScrollBar>
#include <algorithm>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Icons.h"
#include "app/gui/theme/Pages.h"
#include "app/gui/theme/Theme.h"

namespace tacto::gui {

namespace {

constexpr int kDockHeader = 32;
constexpr int kDockPadding = 12;
constexpr int kDockIcon = 16;

/// A header with the designed height and width. The dock takes both from the header's size hint and is never narrower,
/// folded or not.
class DockHeader final : public QWidget {
public:
    using QWidget::QWidget;
    [[nodiscard]] QSize sizeHint() const override { return {QWidget::sizeHint().width(), scaledPx(kDockHeader)}; }
    [[nodiscard]] QSize minimumSizeHint() const override {
        return {std::max(QWidget::minimumSizeHint().width(), scaledPx(FoldingDock::kWidth)), scaledPx(kDockHeader)};
    }
};

}  // namespace

FoldingDock::FoldingDock(const QString& title, const QString& iconName, const QString& name, QWidget* parent)
    : QDockWidget(title, parent),
      icon_(iconName),
      header_(new DockHeader(this)),
      picture_(new QLabel(header_)),
      title_(new QLabel(title, header_)),
      toggle_(new QToolButton(header_)) {
    setObjectName(name);
    auto* row = rowIn(*header_, 8, {kDockPadding, 0, 4, 0});
    row->addWidget(picture_);
    row->addWidget(title_, 1);
    row->addWidget(toggle_);
    toggle_->setFocusPolicy(Qt::TabFocus);
    connect(toggle_, &QToolButton::clicked, this, [this] { fold(!folded_); });
    setTextSize(*title_, TextSize::Body, true);
    header_->installEventFilter(this);
    setTitleBarWidget(header_);
    dress();
    onLookChange(*this, [this] {
        dress();
        limitHeight();
    });
}

void FoldingDock::setContent(QWidget* content, Room room) {
    room_ = room;
    auto* body = new QWidget(this);
    auto* column = columnIn(*body, -1, {kDockPadding, 4, 0, kDockPadding});
    if (qobject_cast<QAbstractScrollArea*>(content) == nullptr) {
        inside_ = new QWidget;
        auto* rows = columnIn(*inside_, -1, {0, 0, kDockPadding, 0});
        rows->addWidget(content);
        rows->addStretch();
        auto* area = scrollingRows(inside_, body);
        area->setSizeAdjustPolicy(QAbstractScrollArea::AdjustToContents);
        area->setFocusPolicy(Qt::NoFocus);
        bar_ = area->verticalScrollBar();
        content = area;
    } else if (auto* area = qobject_cast<QScrollArea*>(content)) {
        inside_ = area->widget();
        bar_ = area->verticalScrollBar();
    }
    if (bar_ != nullptr) bar_->installEventFilter(this);
    if (content->toolTip().isEmpty()) content->setWhatsThis(tr("%1. The arrow keys scroll it.").arg(title_->text()));
    column->addWidget(content);
    setWidget(body);
    if (inside_ != nullptr) inside_->installEventFilter(this);
}

void FoldingDock::fold(bool folded) {
    if (folded_ == folded) return;
    folded_ = folded;
    if (widget() != nullptr) widget()->setVisible(!folded);
    limitHeight();
    dress();
    emit foldChanged();
}

void FoldingDock::limitHeight() {
    int most = QWIDGETSIZE_MAX;
    if (folded_) {
        most = header_->sizeHint().height() + 1;
    } else if (room_ == Room::First && inside_ != nullptr && !isFloating()) {
        most = wantedHeight();
    }
    if (most != maximumHeight()) setMaximumHeight(most);
}

int FoldingDock::wantedHeight() const {
    if (inside_ == nullptr || inside_->layout() == nullptr) return sizeHint().height();
    return heightBeside() + wholeHeightAt(*inside_->layout(), inside_->width());
}

/// The height of header and margins.
int FoldingDock::heightBeside() const {
    const auto margins = widget()->layout()->contentsMargins();
    return header_->height() + 1 + margins.top() + margins.bottom();
}

int FoldingDock::heightDownTo(const QWidget& part, int y) const {
    return heightBeside() + part.mapTo(inside_, QPoint(0, y)).y();
}

void FoldingDock::noteContent() {
    limitHeight();
    if (!folded_ && std::exchange(wanted_, wantedHeight()) != wantedHeight()) emit contentChanged();
}

/// The scroll bar takes the place of the padding, so that the content keeps its width and nothing is cut off.
void FoldingDock::makeRoomForBar(bool shown) {
    inside_->layout()->setContentsMargins(0, 0, shown ? 0 : kDockPadding, 0);
}

/// A click folds and unfolds; a drag moves the dock, and a double click lets it float.
void FoldingDock::noteHeader(const QEvent& event) {
    const auto type = event.type();
    if (type == QEvent::MouseButtonDblClick) return fold(!folded_);  // takes its first click back
    if (type != QEvent::MouseButtonPress && type != QEvent::MouseButtonRelease) return;
    const auto& mouse = static_cast<const QMouseEvent&>(event);
    const auto from = std::exchange(pressed_, std::nullopt);
    if (mouse.button() != Qt::LeftButton) return;
    const auto at = mouse.globalPosition().toPoint();
    if (type == QEvent::MouseButtonPress)
        pressed_ = at;
    else if (from && (at - *from).manhattanLength() < QApplication::startDragDistance())
        fold(!folded_);
}

bool FoldingDock::eventFilter(QObject* watched, QEvent* event) {
    if (watched == header_) noteHeader(*event);
    if (watched == bar_ && (event->type() == QEvent::Show || event->type() == QEvent::Hide))
        makeRoomForBar(event->type() == QEvent::Show);
    if (watched == inside_ && (event->type() == QEvent::LayoutRequest || event->type() == QEvent::Resize))
        noteContent();
    return QDockWidget::eventFilter(watched, event);
}

void FoldingDock::dress() {
    header_->updateGeometry();
    picture_->setPixmap(iconPixmap(icon_, colours().text, scaledPx(kDockIcon), devicePixelRatioF()));
    toggle_->setIcon(icon(folded_ ? "chevron-right" : "chevron-down"));
    const auto says = folded_ ? tr("Unfold %1") : tr("Fold %1");
    toggle_->setAccessibleName(says.arg(windowTitle()));
    toggle_->setToolTip(toggle_->accessibleName());
}

}  // namespace tacto::gui

#include "moc_FoldingDock.cpp"

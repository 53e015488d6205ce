#include "app/gui/theme/TabbedPage.h"

#include "app/gui/theme/Building.h"
#include "app/gui/theme/ToolRow.h"

namespace tacto::gui {

namespace {

constexpr int kToolsApart = 8;  // pixels between tools and tabs, and to the right edge

/// A tab bar that always shows all tabs in full; tools that do not fit move into a menu.
class WholeTabBar final : public QTabBar {
public:
    using QTabBar::QTabBar;
    [[nodiscard]] QSize minimumSizeHint() const override { return QTabBar::sizeHint(); }
};

}  // namespace

TabbedPage::TabbedPage(QWidget* parent)
    : QWidget(parent),
      head_(new QWidget(this)),
      bar_(new WholeTabBar(this)),
      tools_(new PageStack(this)),
      pages_(new PageStack(this)) {
    bar_->setExpanding(false);
    bar_->setDrawBase(false);
    bar_->setWhatsThis(tr("The pages of this workspace. The left and right arrow keys change the page."));
    bar_->setUsesScrollButtons(false);
    head_->setObjectName("tabRow");
    head_->setAttribute(Qt::WA_StyledBackground);
    const auto both = [this] { return bar_->sizeHint().width() + tools_->minimumSizeHint().width() + 2 * kToolsApart; };
    auto* row = new TurningRow(both, head_);
    row->setSpacing(kToolsApart);
    row->setContentsMargins(0, 0, kToolsApart, 0);
    row->addWidget(bar_, 0, Qt::AlignBottom);
    row->addWidget(tools_, 1);
    auto* column = columnIn(*this, 0);
    column->addWidget(head_);
    column->addWidget(pages_, 1);
    tools_->setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
    connect(bar_, &QTabBar::currentChanged, this, [this](int index) {
        bar_->updateGeometry();  // the title of the chosen tab is bold, and so wider
        pages_->setCurrentIndex(index);
        tools_->setCurrentIndex(index);
        emit currentChanged(index);
    });
}

void TabbedPage::addTab(QWidget* page, const QString& title, QWidget* tools) {
    pages_->addWidget(page);
    if (tools == nullptr) tools = new QWidget(tools_);
    tools_->addWidget(tools);
    tabAfter(*bar_, *tools);
    bar_->addTab(title);
    auto* key = new QShortcut(QKeySequence::mnemonic(title), this);
    key->setEnabled(false);
    connect(key, &QShortcut::activated, this, [this, index = int(keys_.size())] { setCurrentIndex(index); });
    keys_.push_back(key);
}

void TabbedPage::setHeadVisible(bool visible) {
    head_->setVisible(visible);
    for (auto* key : keys_) key->setEnabled(!visible);
}

namespace {

/// Puts the widgets in `place` after `before` in the tab order. Returns the last one.
QWidget* chain(QWidget* before, const QWidget& place) {
    for (auto* each : place.findChildren<QWidget*>(Qt::FindDirectChildrenOnly)) {
        if (each->isWindow()) continue;
        // Skips a widget with a focus proxy: the proxy has its own turn.
        if ((each->focusPolicy() & Qt::TabFocus) != 0 && each->focusProxy() == nullptr) {
            QWidget::setTabOrder(before, each);
            before = each;
        }
        before = chain(before, *each);
    }
    return before;
}

}  // namespace

void tabAfter(QWidget& before, QWidget& place) {
    // setTabOrder() accepts only widgets that take the focus: goes back to the last one of these.
    auto* last = &before;
    do {
        if (last->focusPolicy() != Qt::NoFocus) break;
        last = last->previousInFocusChain();
    } while (last != &before);
    chain(last, place);
}

}  // namespace tacto::gui

#include "moc_TabbedPage.cpp"

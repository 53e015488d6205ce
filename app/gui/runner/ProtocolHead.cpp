#include "app/gui/runner/ProtocolHead.h"

#include <QPushButton>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Labels.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/scripting/engine/ProtocolLibrary.h"

namespace tacto::gui {

namespace {
constexpr int kBelow = 4, kBeside = 12;  // gaps between the parts
constexpr int kLineChars = 8;            // least width of the title in characters
}  // namespace

ProtocolHead::ProtocolHead(bool chooses, QWidget* parent)
    : QWidget(parent), layout_(new QBoxLayout(QBoxLayout::TopToBottom, this)), buttons_(new QHBoxLayout) {
    layout_->setContentsMargins(0, 0, 0, 0);
    layout_->setSpacing(kBelow);
    const auto words = [this](const char* name) {
        auto* label = makeLabel({}, {.name = name, .wraps = true, .plain = true}, this);
        layout_->addWidget(label);
        return label;
    };
    if (chooses) {
        chooser_ = new QComboBox(this);
        nameWidget(*chooser_, "chooser", tr("Protocol"),
                   tr("Protocols that came with the program, and the lab's own."));
        chooser_->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
        connect(chooser_, &QComboBox::currentIndexChanged, this,
                [this] { emit chosen(chooser_->currentData().toString()); });
        layout_->addWidget(chooser_);
    }
    title_ = words("protocolTitle");
    setTextSize(*title_, TextSize::Body, true);
    purpose_ = words("purpose");
    setTextSize(*purpose_, TextSize::Small);
    setTone(*purpose_, Tone::Quiet);
    line_ = makeLabel<ElidedLabel>({}, {.size = TextSize::Body, .strong = true, .plain = true}, this);
    layout_->addWidget(line_);
    line_->hide();
    if (chooses) {
        addButton(tr("Ed&it…"), tr("Opens the script. Shipped ones are read-only: save a copy."),
                  &ProtocolHead::editWanted);
        addButton(tr("&New…"), tr("A protocol of your own, from a small template."), &ProtocolHead::newWanted);
    } else {
        addButton(tr("Scr&ipt…"), tr("Shows how it is done: the script of this protocol, and its reference."),
                  &ProtocolHead::editWanted);
    }
    buttons_->addStretch();
    layout_->addLayout(buttons_);
    onEvent(*this, QEvent::Resize, [this] { fitLine(); });
}

void ProtocolHead::setAcross(bool across) {
    across_ = across;
    layout_->setDirection(across ? QBoxLayout::LeftToRight : QBoxLayout::TopToBottom);
    layout_->setSpacing(across ? kBeside : kBelow);
    layout_->setStretchFactor(line_, across ? 1 : 0);
    if (chooser_ != nullptr) {  // in a row as wide as its words, in a column as wide as the column
        chooser_->setSizeAdjustPolicy(across ? QComboBox::AdjustToContents
                                             : QComboBox::AdjustToMinimumContentsLengthWithIcon);
        chooser_->setSizePolicy(across ? QSizePolicy::Minimum : QSizePolicy::Preferred, QSizePolicy::Fixed);
    }
    showWords();
}

void ProtocolHead::showWords() {
    title_->setVisible(!across_ && chooser_ == nullptr);  // if there is a chooser, it shows the title
    purpose_->setVisible(!across_ && !purpose_->text().isEmpty());
    line_->setText(title_->text());
    line_->setToolTip(
        QString("<p><b>%1</b></p>%2").arg(title_->text().toHtmlEscaped(), purpose_->text().toHtmlEscaped()));
    fitLine();
}

/// Hides the title if only a few letters would fit: the side rail and the tab show the same name.
void ProtocolHead::fitLine() {
    int taken = buttons_->sizeHint().width() + kBeside;
    if (chooser_ != nullptr) taken += chooser_->sizeHint().width() + kBeside;
    line_->setVisible(across_ && width() - taken >= line_->fontMetrics().averageCharWidth() * kLineChars);
}

void ProtocolHead::addButton(const QString& text, const QString& tip, void (ProtocolHead::*wanted)()) {
    auto* button = pageButton(text, {}, tip, this);
    connect(button, &QPushButton::clicked, this, wanted);
    buttons_->addWidget(button);
}

bool ProtocolHead::fill(const QString& select) {
    {
        const QSignalBlocker quiet(chooser_);
        chooser_->clear();
        const ProtocolLibrary library;
        for (const auto& source : library.list()) {
            const auto name = QString::fromStdString(source.name);
            const auto title = procedureText(source.name);
            chooser_->addItem(source.shipped ? title : tr("%1 (the lab's own)").arg(title), name);
            chooser_->setItemData(chooser_->count() - 1,
                                  tr("%1: %2").arg(name, QString::fromStdString(originOf(source))), Qt::ToolTipRole);
        }
        for (const auto& refused : library.refused()) {
            const auto path = QString::fromStdString(refused.path.string());
            chooser_->addItem(tr("%1 (refused)").arg(path), path);
            chooser_->setItemData(chooser_->count() - 1, QString::fromStdString(refused.why), Qt::ToolTipRole);
        }
        if (chooser_->count() == 0) return false;
        chooser_->setCurrentIndex(std::max(0, chooser_->findData(select)));
    }
    emit chosen(chooser_->currentData().toString());
    return true;
}

void ProtocolHead::setChangeable(bool changeable) {
    if (chooser_ != nullptr) chooser_->setEnabled(changeable);
}

void ProtocolHead::show(const QString& title, const QString& purpose) {
    title_->setText(title);
    purpose_->setText(purpose);
    showWords();
}

}  // namespace tacto::gui

#include "moc_ProtocolHead.cpp"

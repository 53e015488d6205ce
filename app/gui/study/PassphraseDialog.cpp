#include "app/gui/study/PassphraseDialog.h"

#include <QClipboard>
#include <QDialogButtonBox>
#include <QFormLayout>
#include <QGuiApplication>
#include <QInputMethodEvent>
#include <QKeyEvent>
#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include "app/gui/theme/Building.h"
#include "app/gui/theme/Text.h"
#include "core/base/Utf16.h"
#include "core/seal/Passphrase.h"

namespace tacto::gui {

namespace {
constexpr int kPassphraseChars = 60;
}

PassphraseDialog::PassphraseDialog(Purpose purpose, const QString& study, QWidget* parent)
    : QDialog(parent),
      purpose_(purpose),
      study_(study),
      first_(new PassphraseEdit(this)),
      trouble_(
          makeLabel({}, {.name = "passphraseTrouble", .tone = Tone::Warning, .wraps = true, .plain = true}, this)) {
    const bool isNew = purpose != Purpose::Open, changes = purpose == Purpose::Change;
    setObjectName("passphraseDialog");
    setWindowTitle(changes ? tr("Change the passphrase")
                   : isNew ? tr("A passphrase for the new study")
                           : tr("Open a study"));
    auto* column = new QVBoxLayout(this);
    column->addWidget(heading(changes ? tr("Another passphrase for “%1”").arg(study)
                              : isNew ? tr("A passphrase for “%1”").arg(study)
                                      : tr("“%1” is sealed").arg(study),
                              this));
    column->addWidget(explanation(
        changes ? tr("The key file is sealed anew. Copies of it still open with the passphrase of their time: replace "
                     "them. A lost passphrase is lost data.")
        : isNew
            ? tr("It seals who takes part and what they answer. It is kept nowhere: a lost passphrase is lost data. "
                 "Write it on paper, seal that in an envelope and lock it away.")
            : tr("Codes, answers and levels are read with its passphrase only."),
        this));
    auto* form = new QFormLayout;
    if (changes) {
        soFar_ = new PassphraseEdit(this);
        nameWidget(*soFar_, "passphraseSoFar", tr("Passphrase so far"));
        form->addRow(tr("Passphrase &so far"), soFar_);
        connect(soFar_, &PassphraseEdit::edited, this, &PassphraseDialog::judge);
    }
    first_->setObjectName("passphrase");
    first_->setMinimumWidth(fontMetrics().averageCharWidth() * kPassphraseChars);
    form->addRow(changes ? tr("&New passphrase") : tr("&Passphrase"), first_);
    if (isNew) {
        second_ = new PassphraseEdit(this);
        nameWidget(*second_, "passphraseAgain", tr("Passphrase once more"));
        form->addRow(tr("&Once more"), second_);
        connect(second_, &PassphraseEdit::edited, this, &PassphraseDialog::judge);
        connect(second_, &QLineEdit::returnPressed, this, &PassphraseDialog::give);
    }
    column->addLayout(form);
    trouble_->setMinimumHeight(2 * fontMetrics().height());
    column->addWidget(trouble_);
    column->addStretch();
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    cancel_ = buttons->button(QDialogButtonBox::Cancel);
    go_ = buttons->addButton(changes ? tr("Change the passphrase")
                             : isNew ? tr("Create the study")
                                     : tr("Open"),
                             QDialogButtonBox::ActionRole);
    go_->setObjectName("usePassphrase");
    makePrimary(*go_);
    for (auto* button : buttons->buttons()) static_cast<QPushButton*>(button)->setAutoDefault(false);
    column->addWidget(buttons);
    connect(first_, &PassphraseEdit::edited, this, &PassphraseDialog::judge);
    connect(first_, &QLineEdit::returnPressed, this, &PassphraseDialog::give);
    connect(go_, &QPushButton::clicked, this, &PassphraseDialog::give);
    connect(buttons, &QDialogButtonBox::rejected, this, &PassphraseDialog::reject);
    judge();
    (soFar_ != nullptr ? soFar_ : first_)->setFocus();
}

void PassphraseDialog::judge() {
    bool whole = !first_->isEmpty() && (soFar_ == nullptr || !soFar_->isEmpty());
    if (second_ != nullptr) {
        const auto typed = first_->isEmpty() ? Result<Passphrase>(fail(ErrorCode::InvalidArgument, ""))
                                             : Passphrase::from(first_->typed());
        const auto strong = typed ? typed->checkStrength(study_.toStdString()) : Result<void>();
        const bool differs = !second_->isEmpty() && !first_->equals(*second_);
        trouble_->setText(!strong             ? sentence(strong.error())
                          : differs           ? tr("The two are not the same yet.")
                          : first_->isEmpty() ? tr("Enter the passphrase twice; four words drawn at random are enough.")
                                              : QString());
        whole = whole && strong && first_->equals(*second_);
    }
    go_->setEnabled(whole && !looking_);
    cancel_->setEnabled(mayCancel());
}

bool PassphraseDialog::mayCancel() const { return !looking_ || purpose_ == Purpose::Open; }

void PassphraseDialog::reject() {
    if (!mayCancel()) return;
    if (looking_) emit givenUp();
    QDialog::reject();
}

void PassphraseDialog::give() {
    if (!go_->isEnabled()) return;
    passphrase_ = std::make_shared<const Secret>(first_->typed());
    looking_ = true;
    judge();
    trouble_->setText(purpose_ == Purpose::New      ? tr("Making the keys…")
                      : purpose_ == Purpose::Change ? tr("Sealing the keys…")
                                                    : tr("Opening…"));
    emit given();
}

bool PassphraseDialog::knows(const Secret& held) const {
    return soFar_ != nullptr && std::ranges::equal(soFar_->typed().bytes(), held.bytes());
}

void PassphraseDialog::refuse(const QString& why) {
    looking_ = false;
    passphrase_.reset();
    for (auto* each : {soFar_, first_, second_})
        if (each != nullptr) each->wipe();
    (soFar_ != nullptr ? soFar_ : first_)->setFocus();
    judge();
    trouble_->setText("⚠ " + why);
    adjustSize();
}

namespace {

bool continues(std::byte byte) { return (std::to_integer<unsigned>(byte) & 0xC0U) == 0x80U; }  // of UTF-8

}  // namespace

PassphraseEdit::PassphraseEdit(QWidget* parent) : QLineEdit(parent), held_(kMaxBytes) {
    setAccessibleName(tr("Passphrase"));
    setContextMenuPolicy(Qt::NoContextMenu);
    setAcceptDrops(false);
    setInputMethodHints(Qt::ImhHiddenText | Qt::ImhSensitiveData | Qt::ImhNoPredictiveText | Qt::ImhNoAutoUppercase);
}

Secret PassphraseEdit::typed() const { return Secret(held_.bytes().first(size_)); }

bool PassphraseEdit::equals(const PassphraseEdit& other) const noexcept {
    return size_ == other.size_ && std::ranges::equal(held_.bytes().first(size_), other.held_.bytes().first(size_));
}

void PassphraseEdit::wipe() {
    std::ranges::fill(held_.bytes(), std::byte{0});
    size_ = 0;
    showDots();
}

void PassphraseEdit::add(const QString& text) {
    if (hasSelectedText() && !text.isEmpty()) wipe();
    for (const char32_t point : text.toUcs4()) {
        if (point < 0x20 || point == 0x7F) continue;
        std::array<char, 4> utf8{};
        const std::size_t bytes = encodeUtf8(point, utf8);
        if (size_ + bytes > held_.size()) break;
        std::memcpy(held_.bytes().data() + size_, utf8.data(), bytes);
        size_ += bytes;
    }
    showDots();
}

void PassphraseEdit::takeLast() {
    if (hasSelectedText()) return wipe();
    while (size_ > 0) {
        const auto byte = std::exchange(held_.bytes()[--size_], std::byte{0});
        if (!continues(byte)) break;
    }
    showDots();
}

void PassphraseEdit::showDots() {
    const auto all = held_.bytes().first(size_);
    setText(QString(qsizetype(std::ranges::count_if(all, [](std::byte byte) { return !continues(byte); })), u'●'));
    emit edited();
}

bool PassphraseEdit::event(QEvent* event) {
    // A letter is text here, not a shortcut.
    if (event->type() == QEvent::ShortcutOverride && !static_cast<QKeyEvent*>(event)->text().isEmpty()) {
        const auto* key = static_cast<QKeyEvent*>(event);
        const bool chord = key->modifiers() & (Qt::ControlModifier | Qt::AltModifier);
        if (key->matches(QKeySequence::SelectAll) || (key->key() != Qt::Key_Escape && !chord)) event->accept();
    }
    return QLineEdit::event(event);
}

void PassphraseEdit::keyPressEvent(QKeyEvent* event) {
    if (event->matches(QKeySequence::Paste)) return add(QGuiApplication::clipboard()->text());
    if (event->matches(QKeySequence::SelectAll)) return selectAll();
    switch (event->key()) {
        case Qt::Key_Delete:
            if (hasSelectedText()) wipe();
            return;
        case Qt::Key_Backspace:
            return event->modifiers() & Qt::ControlModifier ? wipe() : takeLast();
        case Qt::Key_Return:
        case Qt::Key_Enter:
        case Qt::Key_Tab:
        case Qt::Key_Backtab:
        case Qt::Key_Escape:
            return QLineEdit::keyPressEvent(event);
        default:
            break;
    }
    const bool isText = !event->text().isEmpty() && event->text().front().isPrint() &&
                        (!(event->modifiers() & (Qt::ControlModifier | Qt::AltModifier)) ||
                         event->modifiers() & Qt::GroupSwitchModifier || event->text().front().unicode() > 0x7F);
    if (isText)
        add(event->text());
    else
        event->ignore();
}

void PassphraseEdit::inputMethodEvent(QInputMethodEvent* event) {
    if (!event->commitString().isEmpty()) add(event->commitString());
    event->accept();
}

/// A click only sets the focus: the cursor always stays at the end. Only all of it can be selected.
void PassphraseEdit::mousePressEvent(QMouseEvent* event) {
    setFocus(Qt::MouseFocusReason);
    deselect();
    event->accept();
}

void PassphraseEdit::mouseMoveEvent(QMouseEvent* event) { event->accept(); }

void PassphraseEdit::mouseDoubleClickEvent(QMouseEvent* event) {
    selectAll();
    event->accept();
}

void PassphraseEdit::mouseReleaseEvent(QMouseEvent* event) { event->accept(); }

}  // namespace tacto::gui

#include "moc_PassphraseDialog.cpp"

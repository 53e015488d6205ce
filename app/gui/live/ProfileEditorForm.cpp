// How the profile editor is laid out.
#include <QFormLayout>
#include <QHBoxLayout>
#include <QScreen>
#include <QScrollArea>
#include <QVBoxLayout>

#include "app/gui/live/ProfileEditor.h"
#include "app/gui/theme/Text.h"
#include "app/gui/theme/Theme.h"
#include "app/run/Shipped.h"

namespace tacto::gui {

namespace {
constexpr int kPollInterval_ms = 100;
}

ProfileEditor::ProfileEditor(BenchController& controller, QWidget* parent) : QDialog(parent), controller_(controller) {
    setWindowTitle(tr("Encoding profile"));
    auto* layout = new QVBoxLayout(this);
    layout->addWidget(
        explanation(tr("How touch becomes pulse trains. The encoding changes while the output is disarmed; "
                       "the limits always apply."),
                    this));
    auto* split = new QHBoxLayout;
    auto* left = new QVBoxLayout;
    auto* naming = new QHBoxLayout;
    auto* nameLabel = new QLabel(tr("&Name"), this);
    name_ = new QLineEdit(this);
    name_->setToolTip(tr("Stands in reports and session files."));
    nameLabel->setBuddy(name_);
    connect(name_, &QLineEdit::textChanged, this, &ProfileEditor::judge);
    naming->addWidget(nameLabel);
    naming->addWidget(name_, 1);
    left->addLayout(naming);
    tabs_ = new QTabWidget(this);
    for (int tab = 0; tab < kProfileTabs; ++tab)
        tabs_->addTab(buildTab(static_cast<ProfileTab>(tab)), titleOf(static_cast<ProfileTab>(tab)));
    left->addWidget(tabs_, 1);
    split->addLayout(left);
    auto* right = new QVBoxLayout;
    preview_ = new ProfilePreview(this);
    right->addWidget(preview_, 1);
    facts_ = new QLabel(this);
    facts_->setObjectName("profileFacts");
    facts_->setWordWrap(true);
    facts_->setAlignment(Qt::AlignTop | Qt::AlignLeft);
    facts_->setMinimumHeight(fontMetrics().height() * 4);
    right->addWidget(facts_);
    split->addLayout(right, 1);
    layout->addLayout(split, 1);
    says_ = new QLabel(this);
    says_->setObjectName("profileTrouble");
    says_->setWordWrap(true);
    layout->addWidget(says_);
    layout->addWidget(buildButtons());
    fill(controller_.profile());
    connect(&controller_, &BenchController::changed, this, [this] {
        applying_ = false;
        judge();
    });
    connect(&controller_, &BenchController::failed, this, [this](const QString& what) {
        if (std::exchange(applying_, false)) say(tr("Not applied: %1").arg(what), true);
    });
    connect(&look_, &QTimer::timeout, this, [this] {
        const auto telemetry = controller_.telemetry();
        preview_->setPoint(telemetry.roughness, telemetry.pressure);
        preview_->setImpedance(telemetry.impedance_ohm);
        facts_->setText(preview_->facts());
    });
    look_.start(kPollInterval_ms);
    tabs_->setFocus();
    const auto room = screen()->availableSize() * 0.9;
    resize(QSize(fontMetrics().averageCharWidth() * 135, fontMetrics().height() * 40).boundedTo(room));
}

QWidget* ProfileEditor::buildTab(ProfileTab tab) {
    auto* area = new QScrollArea(this);
    area->setWidgetResizable(true);
    area->setFrameShape(QFrame::NoFrame);
    area->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* page = new QWidget(area);
    auto* form = new QFormLayout(page);
    form->setFieldGrowthPolicy(QFormLayout::ExpandingFieldsGrow);
    for (const auto& field : profileForm()) {
        if (field.tab != tab) continue;
        auto row = buildRow(field, page);
        auto* holder = new QWidget(page);
        auto* column = new QVBoxLayout(holder);
        column->setContentsMargins(0, 0, 0, 0);
        column->setSpacing(1);
        auto* across = new QHBoxLayout;
        if (row.box != nullptr) {
            across->addWidget(row.box, 1);
        } else {
            across->addWidget(row.line);
            across->addSpacing(fontMetrics().averageCharWidth());
            auto* range = new QLabel(field.range(), holder);
            setTone(*range, Tone::Quiet);
            across->addWidget(range, 1);
        }
        column->addLayout(across);
        column->addWidget(row.refusal);
        row.label->setBuddy(row.box != nullptr ? static_cast<QWidget*>(row.box) : row.line);
        form->addRow(row.label, holder);
        rows_.push_back(row);
    }
    area->setWidget(page);
    area->setMinimumWidth(page->sizeHint().width() + fontMetrics().averageCharWidth() * 4);
    return area;
}

ProfileEditor::Row ProfileEditor::buildRow(const ProfileField& field, QWidget* page) {
    Row row;
    row.field = &field;
    row.label = new QLabel(profileWords(field.label), page);
    row.refusal = new QLabel(page);
    row.refusal->setObjectName(QString("%1.refusal").arg(field.key));
    row.refusal->setWordWrap(true);
    row.refusal->hide();
    QWidget* input = nullptr;
    if (field.isChoice()) {
        input = row.box = new QComboBox(page);
        for (std::size_t i = 0; i < field.form.words.size(); ++i)
            row.box->addItem(profileWords(field.form.words[i]), qtext(field.stored->words[i]));
        connect(row.box, &QComboBox::currentIndexChanged, this, &ProfileEditor::judge);
    } else {
        input = row.line = new QLineEdit(page);
        row.line->setAlignment(Qt::AlignRight);
        row.line->setFixedWidth(fontMetrics().horizontalAdvance("000000000000"));
        connect(row.line, &QLineEdit::textChanged, this, &ProfileEditor::judge);
    }
    input->setObjectName(field.key);
    input->setToolTip(profileWords(field.tip));
    row.label->setToolTip(profileWords(field.tip));
    return row;
}

QWidget* ProfileEditor::buildButtons() {
    auto* holder = new QWidget(this);
    auto* row = new QHBoxLayout(holder);
    row->setContentsMargins(0, 0, 0, 0);
    const auto button = [&](const QString& text, const QString& tip, auto slot) {
        auto* made = new QPushButton(text, holder);
        made->setToolTip(tip);
        made->setAutoDefault(false);
        connect(made, &QPushButton::clicked, this, slot);
        row->addWidget(made);
        return made;
    };
    button(tr("&Open…"), tr("A profile from a file (JSON) into this form."), &ProfileEditor::chooseFile);
    save_ = button(tr("&Save…"), tr("This form into a file (JSON)."), &ProfileEditor::chooseTarget);
    button(tr("S&hipped values"), tr("The values that come with the program, into this form."), [this] {
        if (const auto shipped = shippedProfile())
            fill(*shipped);
        else
            say(QString::fromStdString(shipped.error().message), true);
    });
    row->addStretch();
    button(tr("&Close"), tr("Leaves the bench as it is."), &QDialog::reject);
    apply_ = button(tr("&Apply"), tr("In force from the next train on."), &ProfileEditor::apply);
    return holder;
}

}  // namespace tacto::gui

#include "app/gui/runner/ResultPanel.h"

#include <QHBoxLayout>
#include <QHeaderView>
#include <QVBoxLayout>

#include "app/gui/look/Look.h"

namespace tacto::gui {

namespace {

QString wordsOf(const nlohmann::json& value, const QString& key) {
    if (value.is_null()) return "–";
    if (value.is_string()) return QString::fromStdString(value.get<std::string>());
    if (value.is_boolean()) return value.get<bool>() ? QObject::tr("yes") : QObject::tr("no");
    if (value.is_number_integer()) return QString::number(value.get<long long>());
    const auto column = columnName(key);
    if (value.is_number()) return quantityText(value.get<double>(), column.unit, 4);
    return {};
}

/// "9.999 V (sd 1.2 mV, n = 25)" of a statistic, "100 % (96.3 to 100 %)" of an estimate; else empty.
QString summaryOf(const nlohmann::json& value, const QString& key) {
    if (!value.is_object()) return {};
    const auto unit = columnName(key).unit;
    const auto number = [&](const char* name) {
        const auto at = value.find(name);
        return at != value.end() && at->is_number() ? at->get<double>() : std::nan("");
    };
    if (value.contains("mean") && value.contains("n")) {
        return QObject::tr("%1 (sd %2, n = %3)")
            .arg(quantityText(number("mean"), unit, 4), quantityText(number("sd"), unit, 2))
            .arg(int(number("n")));
    }
    if (value.contains("low") && value.contains("high") && value.contains("value")) {
        return QObject::tr("%1 (95 %: %2 to %3)")
            .arg(QString::number(number("value"), 'g', 4), QString::number(number("low"), 'g', 4),
                 QString::number(number("high"), 'g', 4));
    }
    return {};
}

void grow(QTreeWidgetItem* parent, QTreeWidget* tree, const QString& key, const nlohmann::json& value) {
    const auto name = columnName(key);
    auto* item = parent != nullptr ? new QTreeWidgetItem(parent) : new QTreeWidgetItem(tree);
    item->setText(0, name.title.isEmpty() ? key : name.title);
    if (const auto summary = summaryOf(value, key); !summary.isEmpty()) {
        item->setText(1, summary);
        return;
    }
    if (value.is_object()) {
        if (value.contains("name") && value["name"].is_string()) item->setText(0, wordsOf(value["name"], "name"));
        if (value.contains("a") && value.contains("b")) {
            item->setText(0, QString("%1 / %2").arg(wordsOf(value["a"], "a"), wordsOf(value["b"], "b")));
        }
        for (const auto& [inner, part] : value.items()) {
            if (inner == "name" || inner == "a" || inner == "b") continue;
            grow(item, tree, QString::fromStdString(inner), part);
        }
    } else if (value.is_array()) {
        const bool numbers = std::all_of(value.begin(), value.end(), [](const auto& v) { return v.is_number(); });
        QStringList row;
        int index = 0;
        for (const auto& part : value) {
            if (numbers)
                row << wordsOf(part, key);
            else
                grow(item, tree, QString::number(++index), part);
        }
        item->setText(1, numbers ? row.join("   ") : QObject::tr("%n row(s)", nullptr, int(value.size())));
    } else {
        item->setText(1, wordsOf(value, key));
    }
}

}  // namespace

VerdictLook verdictLook(const QString& verdict) {
    const auto& c = colours();
    if (verdict == "pass") return {QObject::tr("✔ PASS"), c.good};
    if (verdict == "fail") return {QObject::tr("✖ FAIL"), c.fault};
    if (verdict == "stopped") return {QObject::tr("■ STOPPED"), c.amber};
    if (verdict == "indeterminate") return {QObject::tr("? INDETERMINATE"), c.amber};
    return {QObject::tr("– NO VERDICT"), c.text};
}

ResultPanel::ResultPanel(QWidget* parent) : QWidget(parent), maker_(this) {
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    verdict_ = new QLabel(this);
    verdict_->setObjectName("verdict");
    auto font = verdict_->font();
    font.setPointSizeF(font.pointSizeF() * 1.8);
    font.setBold(true);
    verdict_->setFont(font);
    layout->addWidget(verdict_);
    why_ = new QLabel(this);
    why_->setObjectName("verdictWhy");
    why_->setWordWrap(true);
    why_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(why_);
    toScript_ = new QPushButton(tr("Show the &line in the script"), this);
    connect(toScript_, &QPushButton::clicked, this, [this] { emit scriptErrorChosen(errorLine_); });
    layout->addWidget(toScript_, 0, Qt::AlignLeft);
    numbers_ = new QTreeWidget(this);
    numbers_->setAccessibleName(tr("Results"));
    numbers_->setHeaderLabels({tr("Result"), tr("Value")});
    numbers_->header()->setSectionResizeMode(0, QHeaderView::ResizeToContents);
    numbers_->setAlternatingRowColors(true);
    layout->addWidget(numbers_, 1);
    files_ = new QLabel(this);
    files_->setWordWrap(true);
    files_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    layout->addWidget(files_);
    auto* row = new QHBoxLayout;
    openReport_ = new QPushButton(tr("Open the re&port"), this);
    openReport_->setToolTip(tr("The PDF, here in the window."));
    connect(openReport_, &QPushButton::clicked, this, [this] { emit reportReady(report_); });
    cancelReport_ = new QPushButton(tr("Cancel the report"), this);
    connect(cancelReport_, &QPushButton::clicked, &maker_, &ReportMaker::cancel);
    reportState_ = new QLabel(this);
    reportState_->setWordWrap(true);
    row->addWidget(openReport_);
    row->addWidget(cancelReport_);
    row->addWidget(reportState_, 1);
    layout->addLayout(row);
    connect(&maker_, &ReportMaker::done, this, [this](const QString& out) {
        if (out.endsWith(".pdf")) report_ = out;
        openReport_->setEnabled(!report_.isEmpty());
        cancelReport_->setVisible(maker_.busy());
        reportState_->setText(maker_.busy() ? tr("Drawing the report…") : tr("The report is written."));
    });
    connect(&maker_, &ReportMaker::failed, this, [this](const QString& why) {
        cancelReport_->setVisible(maker_.busy());
        reportState_->setText(why);
    });
    clear();
}

void ResultPanel::clear() {
    verdict_->setText({});
    why_->setText({});
    files_->setText({});
    reportState_->setText({});
    numbers_->clear();
    report_.clear();
    errorLine_ = 0;
    openReport_->setEnabled(false);
    cancelReport_->hide();
    toScript_->hide();
}

void ResultPanel::show(const FinishedRun& run) {
    clear();
    const auto& outcome = run.result.outcome;
    const auto look = verdictLook(QString::fromStdString(run.result.verdict()));
    verdict_->setText(outcome.error && run.result.verdict().empty() ? tr("✖ DID NOT RUN TO ITS END") : look.text);
    auto palette = this->palette();
    palette.setColor(QPalette::WindowText,
                     outcome.error && run.result.verdict().empty() ? colours().fault : look.colour);
    verdict_->setPalette(palette);
    QStringList why;
    if (outcome.error) why << QString::fromStdString(outcome.error->message) + tr(" Output is off.");
    for (const auto& reason : outcome.reasons) why << QString::fromStdString(reason);
    for (const auto& trouble : run.result.troubles) why << QString::fromStdString(trouble.message);
    if (outcome.abandoned) {
        why << tr(
            "The script still runs and was given up: it cannot reach the bench any more. Output is off. Restart "
            "the program when you can.");
    }
    if (run.result.simulated) why << tr("SIMULATED: no number here was measured on hardware.");
    why_->setText(why.join("\n"));
    errorLine_ = outcome.line;
    toScript_->setVisible(outcome.error && outcome.line > 0);
    showNumbers(outcome.results);
    const auto session = QString::fromStdString(run.result.session.string());
    if (session.isEmpty()) return;  // it never began
    files_->setText(tr("Session: %1").arg(session));
    reportState_->setText(tr("Drawing the report…"));
    cancelReport_->show();
    maker_.make(session, QString::fromStdString(run.pdf.string()));
    maker_.make(session, QString::fromStdString(run.html.string()));
}

void ResultPanel::showNumbers(const nlohmann::json& results) {
    if (!results.is_object()) return;
    for (const auto& [key, value] : results.items()) {
        if (key == "trials") continue;  // one point each in the plane above
        grow(nullptr, numbers_, QString::fromStdString(key), value);
    }
    numbers_->expandToDepth(0);
}

}  // namespace tacto::gui

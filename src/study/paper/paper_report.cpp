#include "study/paper/paper_report.hpp"

#include <cmath>
#include <limits>

#include "study/report/report.hpp"
#include "study/report/statistics.hpp"
#include "study/setups.hpp"

namespace elastolab {

namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
const std::vector<std::string> kMethods = {"fem", "constant-bem", "linear-bem"};

/// Seconds over vertices.
struct Curve {
    std::vector<double> vertices, seconds;

    double at(double n) const { return interpolate_log(vertices, seconds, n); }
    double last_vertices() const { return vertices.empty() ? kUnknown : vertices.back(); }
    double last_seconds() const { return seconds.empty() ? kUnknown : seconds.back(); }
};

Curve curve(const Table& table, const Row& where, const std::string& seconds) {
    const Table rows = table.where(where);
    return {rows.numbers("vertices"), rows.numbers(seconds)};
}

Row paper_precompute(const std::string& method) {
    return {{"way", "paper"}, {"method", method}, {"part", "precompute"}};
}

Row paper_update(const std::string& method, const std::string& update, const std::string& share) {
    return {{"way", "paper"}, {"method", method}, {"part", "update"}, {"update", update}, {"share", share}};
}

Row our_update(const std::string& method, const std::string& update, const std::string& share) {
    return Row(paper_update(method, update, share))
        .set("way", std::string("ours"))
        .set("choice", std::string("random"));
}

/// The number of vertices above which `a` stays above `b`: 0 where it is so at all of them; nothing when there is none.
double crossing(const Curve& a, const Curve& b) {
    double found = 0.0, before = kUnknown, at_before = kUnknown;
    for (std::size_t i = 0; i < a.vertices.size(); ++i) {
        const double at = a.vertices[i], now = std::log(a.seconds[i] / b.at(at));
        if (!std::isfinite(now)) continue;
        if (before <= 0.0 && now > 0.0) {
            const double part = -before / (now - before);
            found = std::exp(std::log(at_before) * (1.0 - part) + std::log(at) * part);
        }
        if (now <= 0.0) found = kUnknown;
        before = now;
        at_before = at;
    }
    return std::isnan(before) ? kUnknown : found;
}

/// The largest cube on which all three methods were run in the paper's way.
double common_vertices(const Table& table) {
    double common = std::numeric_limits<double>::max();
    for (const std::string& method : kMethods)
        common = std::min(common, curve(table, paper_precompute(method), "precompute_s").last_vertices());
    return common;
}

using Claim = std::vector<std::string>;

/// "holds", "does not hold", or for which of several it holds.
std::string verdict(const std::vector<std::string>& for_these, std::size_t of) {
    if (for_these.size() == of) return "holds";
    if (for_these.empty()) return "does not hold here";
    std::string text = "holds for";
    for (const std::string& one : for_these) text += (one == for_these.front() ? " " : ", ") + one;
    return text;
}

/// The number of vertices above which FEM has more nodes, inside ones included, than constant BEM has triangles.
std::string node_crossing(const Table& table) {
    const double at = crossing(curve(table, paper_precompute("fem"), "nodes"),
                               curve(table, paper_precompute("constant-bem"), "nodes"));
    if (std::isnan(at)) return "FEM's nodes, inside ones included, do not outgrow constant BEM's triangles here";
    return "FEM's nodes, inside ones included, outgrow constant BEM's triangles at " +
           (at > 0.0 ? count(at) + " vertices already" : std::string("all sizes here"));
}

Claim crossing_claim(const Table& table) {
    constexpr double kLow = 850.0, kHigh = 1100.0;
    const Curve fem = curve(table, paper_precompute("fem"), "precompute_s");
    const Curve constant = curve(table, paper_precompute("constant-bem"), "precompute_s");
    const double at = crossing(fem, constant), last = std::min(fem.last_vertices(), constant.last_vertices());
    const bool crossed = at > 0.0, always = at == 0.0;
    const std::string there = "at " + count(last) + " vertices FEM takes " + duration(fem.at(last)) +
                              " and constant BEM " + duration(constant.at(last));
    return {"Precomputation: FEM is faster than constant BEM on small cubes and slower beyond 950 to 1000 vertices",
            crossed                   ? (at > kLow && at < kHigh ? "holds" : "holds, at another size")
            : last < kHigh && !always ? "not decided at these sizes"
                                      : "does not hold here",
            (crossed  ? "FEM becomes the slower at " + count(at) + " vertices; "
             : always ? std::string("FEM is the slower at all sizes here; ")
                      : std::string("no crossing; ")) +
                there,
            node_crossing(table) +
                ". Where times cross is decided by constants: FEM inverts a symmetric matrix once, "
                "BEM factorises two that are not and solves for as many columns"};
}

Claim share_claim(const Table& table) {
    const double n = common_vertices(table);
    std::string measured =
        "the paper's way knows no set before K^-1 is there. Ours, first set included, 30 % against 10 %: ";
    for (const std::string& method : kMethods) {
        double seconds[2];
        int i = 0;
        for (const std::string share : {"0.1", "0.3"}) {
            const Row ours{
                {"way", "ours"}, {"method", method}, {"part", "precompute"}, {"share", share}, {"choice", "random"}};
            seconds[i++] = curve(table, ours, "precompute_s").at(n) +
                           curve(table, our_update(method, "on-demand", share), "set_change_s").at(n);
        }
        measured += method + " " + times(seconds[1] / seconds[0]) + (method == kMethods.back() ? "" : ", ");
    }
    // The paper's precomputation does not take the set of known nodes as input, so that nothing measured could differ.
    return {"Precomputation is independent of the share of known nodes", "holds, by construction", measured,
            "K and K^-1 are computed over all nodes. What is computed on demand is not: it is paid per known vertex"};
}

/// The number of vertices above which linear BEM takes at most this part of another method's time.
std::string reaches(const Table& table, const std::string& method, double part) {
    Curve linear = curve(table, paper_precompute("linear-bem"), "precompute_s");
    for (double& seconds : linear.seconds) seconds /= part;
    const double from = crossing(curve(table, paper_precompute(method), "precompute_s"), linear);
    if (std::isnan(from)) return "nowhere here";
    return from > 0.0 ? "from " + count(from) + " vertices on" : "at all sizes here";
}

Claim fifth_claim(const Table& table) {
    constexpr double kAboutAFifth = 0.25;
    const double n = common_vertices(table);
    std::vector<std::string> holds_for;
    std::string measured = "at " + count(n) + " vertices ";
    for (const std::string method : {"fem", "constant-bem"}) {
        const double part = curve(table, paper_precompute("linear-bem"), "precompute_s").at(n) /
                            curve(table, paper_precompute(method), "precompute_s").at(n);
        if (part < kAboutAFifth) holds_for.push_back(method);
        measured += "1/" + short_number(1.0 / part) + " of " + method + " (a quarter or less " +
                    reaches(table, method, kAboutAFifth) + ")" + (method == "fem" ? ", " : "");
    }
    return {"Linear BEM takes a fifth of the time of FEM and of constant BEM", verdict(holds_for, 2), measured,
            "Half the nodes of constant BEM are an eighth of the arithmetic, so a fifth is what remains with the work "
            "that does not grow like the cube; against FEM the ratio falls with the size of the cube"};
}

Claim eqn9_claim(const Table& table, const std::string& share) {
    const double n = common_vertices(table);
    std::string measured = "at " + count(n) + " vertices inverting K00 for each set takes";
    std::string factorised = "; a factorisation of K00";
    std::vector<std::string> holds_for;
    for (const std::string& method : kMethods) {
        const auto seconds = [&](const char* update) {
            return curve(table, paper_update(method, update, share), "set_change_s").at(n);
        };
        const std::string comma = method == kMethods.back() ? "" : ",";
        if (seconds("inverse") > seconds("eqn9")) holds_for.push_back(method);
        const std::string whose = " (" + method + ")" + comma;
        measured += " " + times(seconds("inverse") / seconds("eqn9")) + whose;
        factorised += " " + times(seconds("direct") / seconds("eqn9")) + whose;
    }
    return {"Eqn. 9 makes a new set cheaper with " + percent(std::stod(share)) + " of the nodes known",
            verdict(holds_for, kMethods.size()),
            measured + " as long as Eqn. 9" + factorised + ", which serves as well",
            "It trades an inverse of the free part, 2(N-n)^3, for one of the known part and a product with (N-n)^2 n"};
}

std::string collapsed_findings(const Table& table) {
    const double n = common_vertices(table);
    std::vector<std::vector<std::string>> rows;
    for (const std::string& method : kMethods)
        for (const std::string share : {"0.1", "0.3"}) {
            std::vector<std::string> row = {method, percent(std::stod(share))};
            for (const char* update : {"inverse", "eqn9", "direct", "reduced"})
                row.push_back(duration(curve(table, paper_update(method, update, share), "set_change_s").at(n)));
            for (const char* update : {"on-demand", "known-columns"})
                row.push_back(duration(curve(table, our_update(method, update, share), "set_change_s").at(n)));
            row.push_back(duration(curve(table, paper_update(method, "eqn9", share), "frame_s").at(n)));
            row.push_back(duration(curve(table, our_update(method, "on-demand", share), "frame_s").at(n)));
            rows.push_back(row);
        }
    return "Cube of " + count(n) + " vertices, time to change the set of known nodes, and of a frame:\n\n" +
           markdown_table(
               {"method", "known", "K00 inverted", "Eqn. 9", "K00 factorised", "Eqn. 9 collapsed",
                "on demand, no column known", "on demand, columns known", "frame, paper", "frame, drag response"},
               rows);
}

/// What random vertices hide: few of them make whole triangles, which carry tractions of their own.
std::string patch_findings(const Table& table) {
    const double n = common_vertices(table);
    std::vector<std::vector<std::string>> rows;
    for (const std::string& method : kMethods)
        for (const std::string share : {"0.1", "0.3"}) {
            const Row random = our_update(method, "on-demand", share);
            const Row patches = Row(random).set("choice", std::string("patches"));
            const double at_random = curve(table, random, "set_change_s").at(n);
            const double in_patches = curve(table, patches, "set_change_s").at(n);
            rows.push_back({method, percent(std::stod(share)), duration(at_random), duration(in_patches),
                            times(in_patches / at_random)});
        }
    return "First set on demand at " + count(n) +
           " vertices, known vertices chosen at random and in two patches around opposite corners:\n\n" +
           markdown_table({"method", "known", "random", "two patches", "ratio"}, rows);
}

std::string precompute_findings(const Table& table) {
    const double n = common_vertices(table);
    std::vector<std::vector<std::string>> rows;
    for (const std::string& method : kMethods) {
        const Curve paper = curve(table, paper_precompute(method), "precompute_s");
        const double first = curve(table, paper_update(method, "eqn9", "0.1"), "set_change_s").at(n);
        const double ready = curve(table, our_update(method, "on-demand", "0.1"), "ready_s").at(n);
        rows.push_back({method, duration(paper.at(n)), duration(paper.at(n) + first), duration(ready),
                        times((paper.at(n) + first) / ready),
                        short_number(fitted_exponent(paper.vertices, paper.seconds))});
    }
    return "Precomputation at " + count(n) + " vertices, and until a first set of 10 % is ready as well:\n\n" +
           markdown_table({"method", "paper's way (dense K and K^-1)", "with the first set (Eqn. 9)",
                           "on demand, with the first set", "gain", "exponent of the paper's way over all sizes"},
                          rows) +
           "\nOn demand FEM factorises when a set is known, BEM before.\n";
}

std::string artefact_findings(const Table& table) {
    std::string text = "Fig. 1, largest error of a vertex as a share of the stretch:";
    for (const Row& row : table.where({{"part", "fig1"}}).rows)
        text += " " + row.text("method") + " " + percent(row.number("edge_error")) + " on the edges and " +
                percent(row.number("face_error")) + " inside the faces;";
    text.back() = '.';
    return text + "\n";
}

double worst_disagreement(const Table& table) {
    double worst = 0.0;
    for (const double value : table.numbers("disagreement"))
        if (value > worst) worst = value;
    return worst;
}

Plot time_plot(std::string name, std::string title, const std::string& y_label, bool logarithmic) {
    Plot plot;
    plot.name = std::move(name);
    plot.title = std::move(title);
    plot.x_label = "vertices";
    plot.y_label = y_label;
    plot.log_x = plot.log_y = logarithmic;
    return plot;
}

Plot precomputation_plot(bool logarithmic) {
    Plot plot =
        time_plot(logarithmic ? "fig4-ours" : "fig4-precomputation",
                  logarithmic ? "Precomputation: the paper's way, and ready on demand" : "Fig. 4: precomputation",
                  "precomputation [s]", logarithmic);
    plot.caption =
        logarithmic ? "The same in logarithms, beside what is ready on demand: precomputation and a first set of 10 %."
                    : "Dense K and K^-1 over all nodes of a cube; FEM has its interior nodes.";
    for (const std::string& method : kMethods) {
        plot.series.push_back({logarithmic ? method + ", paper" : method, paper_precompute(method), "vertices",
                               "precompute_s", method_color(method)});
        if (logarithmic)
            plot.series.push_back({method + ", on demand", our_update(method, "on-demand", "0.1"), "vertices",
                                   "ready_s", method_color(method), true});
    }
    return plot;
}

Plot update_plot(const std::string& figure, const std::string& share, bool logarithmic) {
    const std::string percents = percent(std::stod(share));
    Plot plot = logarithmic
                    ? time_plot(figure + "-ours", "Update with " + percents + " known: Eqn. 9 and what replaces it",
                                "set change [s]", true)
                    : time_plot(figure + "-update",
                                (figure == "fig5" ? "Fig. 5" : "Fig. 6") + (": update with " + percents) + " known",
                                "set change [s]", false);
    plot.caption =
        logarithmic ? "Eqn. 9 as written, its collapsed form on the same K^-1, and on demand (solid, dashed, points)."
                    : "New set of known nodes with Eqn. 9 (solid) and by inverting K00 (dashed).";
    for (const std::string& method : kMethods) {
        const int color = method_color(method);
        plot.series.push_back(
            {method + ", Eqn. 9", paper_update(method, "eqn9", share), "vertices", "set_change_s", color});
        if (!logarithmic) {
            plot.series.push_back({method + ", without", paper_update(method, "inverse", share), "vertices",
                                   "set_change_s", color, true});
            continue;
        }
        plot.series.push_back(
            {method + ", collapsed", paper_update(method, "reduced", share), "vertices", "set_change_s", color, true});
        plot.series.push_back({method + ", on demand", our_update(method, "on-demand", share), "vertices",
                               "set_change_s", color, false, "points"});
    }
    return plot;
}

}  // namespace

Conclusions conclude_paper(const Table& table) {
    Conclusions conclusions;
    conclusions.findings =
        "## Does the paper's claim hold?\n\n" +
        markdown_table({"claim", "", "measured", "why"}, {crossing_claim(table), share_claim(table), fifth_claim(table),
                                                          eqn9_claim(table, "0.1"), eqn9_claim(table, "0.3")}) +
        "\n" + precompute_findings(table) + "\n" + collapsed_findings(table) + "\n" + patch_findings(table) +
        "\nThe four ways to get displacements after a new set agree to " + short_number(worst_disagreement(table)) +
        " (relative, worst of all cases).\n\n" + artefact_findings(table);
    for (const bool logarithmic : {false, true}) {
        conclusions.plots.push_back(precomputation_plot(logarithmic));
        conclusions.plots.push_back(update_plot("fig5", "0.1", logarithmic));
        conclusions.plots.push_back(update_plot("fig6", "0.3", logarithmic));
    }
    return conclusions;
}

}  // namespace elastolab

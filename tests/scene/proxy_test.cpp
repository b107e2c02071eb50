// What is computed on a proxy, as the shown surface has it.
#include "scene/proxy/carried_constraints.hpp"

#include <gmock/gmock.h>

#include <Eigen/Geometry>

#include <array>
#include <set>

#include "deform/deformer.hpp"
#include "fem/method.hpp"
#include "fem/nonlinear/method.hpp"
#include "fem/quadratic/method.hpp"
#include "mesh/primitives.hpp"
#include "methods/precompute.hpp"
#include "methods/registry.hpp"
#include "scene/live/drag_solver.hpp"
#include "scene/live/embedded_runner.hpp"
#include "scene/wish.hpp"
#include "support/wait_until.hpp"

namespace elastolab {
namespace {

std::shared_ptr<const Proxy> proxy_of(const SurfaceMesh& mesh, int n_vertices) {
    CheckedMesh checked = check_and_repair(mesh);
    Control control;
    const std::array sizes = {n_vertices};
    return make_proxies("body", std::make_shared<const SurfaceMesh>(checked.mesh), checked.report, sizes, control)
        .front();
}

Selector slab(double low, double high) { return {BoxSelector{{low, -9, -9}, {high, 9, 9}}}; }

/// A bar along x with both ends constrained.
Document bar(const Motion& motion) {
    Document document;
    document.fixed = {{.select = slab(-9, 0.3)}};
    document.handles = {{.name = "end", .select = slab(3.8, 9), .motion = motion}};
    return document;
}

Eigen::VectorXd solved(const CarriedConstraints& carried) {
    Control control;
    const Body body{.name = "body", .surface = carried.proxy().surface, .material = {1.0, 0.3}};
    Deformer deformer(precompute(body, Method{.kind = kQuadraticFem, .update = Update::direct}, control));
    deformer.constrain(carried.constraints().set, control);
    return deformer.displace(carried.constraints().values);
}

const SurfaceMesh kBar = make_primitive("beam", 12, {});

TEST(CarriedConstraints, TakeTheSamePartOfTheProxy) {
    CarriedConstraints carried(proxy_of(kBar, 300));
    carried.set(make_constraints(bar(AffineMotion{}), kBar, "s.json"));
    const Positions& x = carried.proxy().surface->vertices;
    const double reach = carried.proxy().edge;
    const ConstrainedSet& set = carried.constraints().set;
    EXPECT_GT(set.fixed.size(), 5u);
    EXPECT_GT(set.handles.size(), 5u);
    const std::set<int> fixed(set.fixed.begin(), set.fixed.end()), handle(set.handles.begin(), set.handles.end());
    for (int v = 0; v < x.cols(); ++v) {
        if (x(0, v) < 0.3 - reach) {
            EXPECT_TRUE(fixed.contains(v)) << x.col(v).transpose();
        }
        if (x(0, v) > 0.3 + reach) {
            EXPECT_FALSE(fixed.contains(v)) << x.col(v).transpose();
        }
        if (x(0, v) > 3.8 + reach) {
            EXPECT_TRUE(handle.contains(v)) << x.col(v).transpose();
        }
        if (x(0, v) < 3.8 - reach) {
            EXPECT_FALSE(handle.contains(v)) << x.col(v).transpose();
        }
    }
}

TEST(CarriedConstraints, ConstrainedShownVerticesGoExactlyWhereTheyArePut) {
    const AffineMotion turn{.matrix = 0.3 * Eigen::Matrix3d::Random(), .translate = {0.1, 0.2, -0.1}};
    const Constraints shown = make_constraints(bar(turn), kBar, "s.json");
    CarriedConstraints carried(proxy_of(kBar, 300));
    carried.set(shown);
    const Eigen::VectorXd u = carried.displacement(solved(carried));
    for (std::size_t i = 0; i < shown.set.handles.size(); ++i)
        EXPECT_EQ((u.segment<3>(3 * shown.set.handles[i])),
                  (shown.values.segment<3>(3 * static_cast<Eigen::Index>(i))));
    for (const int v : shown.set.fixed) EXPECT_EQ((u.segment<3>(3 * v)), Eigen::Vector3d::Zero());
}

/// Both ends turn about the middle as one: the whole body does, and every shown vertex with it, but for its distance
/// from the proxy.
TEST(CarriedConstraints, ATurnOfEverythingIsATurn) {
    const Eigen::Matrix3d spin = (Eigen::Matrix3d() << 0, -0.2, 0.1, 0.2, 0, -0.3, -0.1, 0.3, 0).finished();
    Document document = bar(AffineMotion{.matrix = spin});
    document.handles.push_back(
        {.name = "other", .select = document.fixed[0].select, .motion = AffineMotion{.matrix = spin}});
    document.fixed.clear();
    const Constraints shown = make_constraints(document, kBar, "s.json");
    CarriedConstraints carried(proxy_of(kBar, 250));
    carried.set(shown);
    const Eigen::VectorXd u = carried.displacement(solved(carried));
    const double off = carried.proxy().places.distance.maxCoeff();
    for (int v = 0; v < kBar.n_vertices(); ++v)
        EXPECT_LT((u.segment<3>(3 * v) - spin * kBar.vertices.col(v)).norm(), spin.norm() * off + 1e-9);
}

TEST(CarriedConstraints, NearbyVerticesFollowWithoutATear) {
    const Constraints shown = make_constraints(bar(AffineMotion{.translate = {0, 0, 0.5}}), kBar, "s.json");
    CarriedConstraints carried(proxy_of(kBar, 120));
    carried.set(shown);
    const Eigen::VectorXd u = carried.displacement(solved(carried));
    double largest = 0.0;
    for (const auto& t : kBar.triangles.colwise())
        for (int i = 0; i < 3; ++i)
            largest = std::max(largest, (u.segment<3>(3 * t[i]) - u.segment<3>(3 * t[(i + 1) % 3])).norm());
    EXPECT_LT(largest, 0.1);  // a twentieth of the bar is the longest edge, and moves by a twentieth at least
}

/// What the proxy answers is changed by no more than what it misses where vertices are held and moved.
TEST(CarriedConstraints, NearbyVerticesKeepAStretchThatTheProxyHas) {
    constexpr double kStretch = 0.1;
    const SurfaceMesh mesh = make_primitive("box", 4, {4, 1, 1});
    Document document;
    document.fixed = {{.select = slab(-9, 1e-6)}};
    document.handles = {
        {.name = "end", .select = slab(4 - 1e-6, 9), .motion = AffineMotion{.translate = {4 * kStretch, 0, 0}}}};
    CarriedConstraints carried(proxy_of(mesh, 60));
    carried.set(make_constraints(document, mesh, "s.json"));
    const Proxy& proxy = carried.proxy();
    Eigen::Matrix3Xd of_proxy = Eigen::Matrix3Xd::Zero(3, proxy.surface->n_vertices());
    of_proxy.row(0) = kStretch * proxy.surface->vertices.row(0);
    const Eigen::VectorXd u = carried.displacement(of_proxy.reshaped());
    const Eigen::RowVectorXd x = mesh.vertices.row(0);
    const Eigen::VectorXd places = carried_values(proxy, proxy.surface->vertices.row(0).transpose());
    const double missed = kStretch * (places.transpose() - x).cwiseAbs().maxCoeff();
    const Eigen::RowVectorXd off = u.reshaped(3, x.size()).row(0) - kStretch * x;
    EXPECT_LT(off.cwiseAbs().maxCoeff(), 2.0 * missed + 1e-9);
    EXPECT_LT(missed, 0.05 * kStretch);
}

TEST(CarriedConstraints, APartSmallerThanATriangleHoldsTheNearestOne) {
    const auto proxy = proxy_of(kBar, 40);
    Document document = bar(AffineMotion{.translate = {0, 0.1, 0}});
    std::vector<int> patch;
    for (const int v : kBar.triangles.col(kBar.n_triangles() / 2)) patch.push_back(v);
    document.handles = {{.name = "spot", .select = {VertexSelector{patch}}, .motion = AffineMotion{}}};
    CarriedConstraints carried(proxy);
    carried.set(make_constraints(document, kBar, "s.json"));
    EXPECT_THAT(carried.constraints().set.handles.size(), testing::AllOf(testing::Ge(1u), testing::Le(4u)));
}

TEST(CarriedConstraints, EveryPieceOfASetHoldsTheProxy) {
    for (const int n_vertices : {30, 120, 500}) {
        Document document = bar(AffineMotion{});
        std::vector<int> spots;  // far from each other
        for (const Eigen::Vector3d& at : {Eigen::Vector3d(0.1, 0.3, 0), {1.9, 1, 0.6}, {1.4, 0, 0.4}, {0.7, 0.4, 1}}) {
            int nearest = 0;
            (kBar.vertices.colwise() - at).colwise().norm().minCoeff(&nearest);
            spots.push_back(nearest);
        }
        document.fixed = {{.select = {VertexSelector{spots}}}};
        const Selector spot{BoxSelector{{2.6, 0.4, 0.9}, {2.8, 0.6, 9}}};
        document.handles[0].select = {std::vector<Selector>{slab(3.8, 9), spot}};
        CarriedConstraints carried(proxy_of(kBar, n_vertices));
        carried.set(make_constraints(document, kBar, "s.json"));
        const Positions& x = carried.proxy().surface->vertices;
        const auto distance = [&](const std::vector<int>& held, const Eigen::Vector3d& from) {
            return (x(Eigen::all, held).colwise() - from).colwise().norm().minCoeff();
        };
        const ConstrainedSet& set = carried.constraints().set;
        for (const int v : spots)
            EXPECT_LT(distance(set.fixed, kBar.vertices.col(v)), 1.6 * carried.proxy().edge) << n_vertices << ", " << v;
        EXPECT_LT(distance(set.handles, {2.7, 0.5, 1}), 1.6 * carried.proxy().edge) << n_vertices;
        EXPECT_LT(distance(set.handles, {4, 0.5, 0.5}), 1.6 * carried.proxy().edge) << n_vertices;
    }
}

TEST(CarriedConstraints, EveryFixedSetHasItsPartOfTheProxy) {
    Document document = bar(AffineMotion{});
    const std::vector<int> spot = {kBar.triangles(0, kBar.n_triangles() / 2)};  // smaller than a triangle of the proxy
    document.fixed = {{.name = "left", .select = slab(-9, 0.3)},
                      {.name = "spot", .select = {VertexSelector{spot}}},
                      {.name = "right", .select = slab(3.5, 3.75)}};
    CarriedConstraints carried(proxy_of(kBar, 300));
    carried.set(make_constraints(document, kBar, "s.json"));
    const Constraints& c = carried.constraints();
    const Positions& x = carried.proxy().surface->vertices;
    ASSERT_THAT(c.fixed_sets, testing::SizeIs(3));
    EXPECT_EQ(c.fixed_sets.front().begin, 0);
    EXPECT_EQ(c.fixed_sets.back().end, std::ssize(c.set.fixed));
    EXPECT_EQ(c.groups[0], (ConstraintGroup{"fixed", 0, static_cast<int>(c.set.fixed.size())}));
    const std::array<double, 3> middle = {0.15, kBar.vertices(0, spot[0]), 3.6};
    for (std::size_t s = 0; s < 3; ++s) {
        const ConstraintGroup& set = c.fixed_sets[s];
        EXPECT_EQ(set.name, document.fixed[s].name);
        EXPECT_LT(set.begin, set.end) << set.name;
        for (int i = set.begin; i < set.end; ++i)
            EXPECT_NEAR(x(0, c.set.fixed[static_cast<std::size_t>(i)]), middle[s], 0.15 + carried.proxy().edge);
    }
}

TEST(CarriedConstraints, APointIsToldOfByTheVertexThatIsShown) {
    const auto proxy = proxy_of(kBar, 300);
    const auto points_told = [&](std::vector<int> pulled) {
        Document document = bar(AffineMotion{});
        document.handles = {{.name = "spot", .select = {VertexSelector{std::move(pulled)}}, .motion = AffineMotion{}}};
        CarriedConstraints carried(proxy);
        carried.set(make_constraints(document, kBar, "s.json"));
        // As the solver of the proxy says it: one of its own vertices.
        const Findings of_proxy = {{.kind = FindingKind::free_motion},
                                   {.kind = FindingKind::point_constraint, .value = 2.0, .first = 299}};
        return carried.as_shown(of_proxy);
    };
    const Eigen::Vector3i patch = kBar.triangles.col(kBar.n_triangles() / 2);
    const Findings of_a_point = points_told({patch[0]});
    ASSERT_THAT(of_a_point, testing::SizeIs(2));
    EXPECT_EQ(of_a_point[0].kind, FindingKind::free_motion);
    EXPECT_EQ(of_a_point[1].kind, FindingKind::point_constraint);
    EXPECT_EQ(of_a_point[1].first, patch[0]);
    EXPECT_EQ(of_a_point[1].value, 1.0);
    EXPECT_THAT(points_told({patch.begin(), patch.end()}), testing::SizeIs(1));
}

TEST(CarriedConstraints, OneDisplacementEachIsInterpolated) {
    Document document =
        bar(AffineMotion{.matrix = Eigen::Vector3d(0.1, 0.2, 0.3).asDiagonal(), .translate = {1, 0, 0}});
    const Constraints affine = make_constraints(document, kBar, "s.json");
    VertexMotion each;
    for (Eigen::Index i = 0; i < affine.values.size(); i += 3)
        each.displacements.push_back(affine.values.segment<3>(i));
    document.handles[0].motion = each;
    const auto proxy = proxy_of(kBar, 300);
    CarriedConstraints one(proxy), other(proxy);
    one.set(affine);
    other.set(make_constraints(document, kBar, "s.json"));
    ASSERT_EQ(one.constraints().set.handles, other.constraints().set.handles);
    EXPECT_LT((one.constraints().values - other.constraints().values).lpNorm<Eigen::Infinity>(),
              0.3 * proxy->edge);  // a vertex beyond the part takes its rim's
}

/// A force acts at the middle of the shown patch; another force on the same patch is carried, too.
TEST(CarriedConstraints, AForceOnAHandleActsWhereItDoesOnTheShownSurface) {
    Document document = bar(AffineMotion{});
    document.handles[0].select = {BoxSelector{{3.4, -9, 0.7}, {9, 9, 9}}};
    CarriedConstraints carried(proxy_of(kBar, 120));
    for (const Eigen::Vector3d& force : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(3, -2, 1)}) {
        document.handles[0].force = GripForce{force, {0.1, 0.2, 0.3}};
        const Constraints shown = make_constraints(document, kBar, "s.json");
        carried.set(shown);
        const GripForce& own = carried.constraints().forces[0].value();
        const Positions& x = carried.proxy().surface->vertices;
        const Eigen::Vector3d at = x(Eigen::all, carried.constraints().set.handles).rowwise().mean(),
                              wanted = kBar.vertices(Eigen::all, shown.set.handles).rowwise().mean();
        EXPECT_GT((at - wanted).norm(), 1e-3);
        EXPECT_EQ(own.force, force);
        const Eigen::Vector3d moment = Eigen::Vector3d(0.1, 0.2, 0.3) + wanted.cross(force);
        EXPECT_LT((own.moment + at.cross(force) - moment).norm(), 1e-12);
    }
}

/// Two neighbours on the shown surface, of which a coarse proxy has a vertex for one only; and an end that is turned.
struct CrowdedBar {
    std::shared_ptr<const Proxy> proxy = proxy_of(kBar, 40);
    Document document = bar(AffineMotion{.rotate = {.axis = {1, 0, 0}, .degrees = 360, .center = {4, 0.5, 0.5}}});

    explicit CrowdedBar(bool swapped) {
        int at = 0;
        (kBar.vertices.colwise() - Eigen::Vector3d(2.0, 0.5, 1.0)).colwise().norm().minCoeff(&at);
        int beside = at;
        for (const auto& triangle : kBar.triangles.colwise())
            if ((triangle.array() == at).any() && beside == at) beside = triangle[triangle[0] == at ? 1 : 0];
        if (swapped) std::swap(at, beside);
        document.handles.push_back(
            {.name = "one", .select = {VertexSelector{{at}}}, .motion = AffineMotion{.translate = {0, 0, 0.02}}});
        document.handles.push_back(
            {.name = "other", .select = {VertexSelector{{beside}}}, .motion = VertexMotion{{{0, 0, 0.01}}}});
    }
    Constraints constraints() const { return make_constraints(document, kBar, "s.json"); }
};

TEST(CarriedConstraints, AHandleWithoutVerticesThereLeavesTheOthersTheirMotions) {
    for (const bool swapped : {false, true}) {
        const CrowdedBar crowded(swapped);
        CarriedConstraints carried(crowded.proxy);
        carried.set(crowded.constraints());
        const Constraints& own = carried.constraints();
        const Wish wish = wish_of(own);
        ASSERT_EQ(wish.motions.size(), 3u);
        ASSERT_EQ(wish.ends.size(), 3u);
        EXPECT_EQ(wish.ends[2], std::ssize(own.set.handles));
        EXPECT_TRUE(wish.ends[1] == wish.ends[0] || wish.ends[2] == wish.ends[1]) << "both have a vertex";
        const Positions rest = crowded.proxy->surface->vertices(Eigen::all, own.set.handles);
        EXPECT_EQ(way_to(wish, nullptr, rest).path.cols(), 3) << "the full turn was lost";
        Control control;
        for (const MethodKind kind : {kNonlinearFem, kFem}) {
            const Body body{.name = "body", .surface = crowded.proxy->surface, .material = {1.0, 0.3}};
            const auto deformer = std::make_shared<Deformer>(
                precompute(body, Method{.kind = kind, .elements = ElementDegree::linear}, control));
            deformer->constrain(own.set, control);
            DragSolver drag(deformer, wish.ends);
            const Eigen::VectorXd values = 0.1 * own.values;
            drag.prepare(values, kSolveTolerance, control);
            Eigen::VectorXd u;
            drag.displace(values, u);
            EXPECT_LT((u - deformer->displace(values)).norm(), 1e-9 * u.norm()) << name(kind);
        }
    }
}

TEST(EmbeddedRunner, MovesTheHandleThatAForceActsOnAndNoneThatIsNotOnTheProxy) {
    for (const bool swapped : {false, true}) {
        CrowdedBar crowded(swapped);
        const Eigen::Vector3d forces[] = {{0, 1e-4, 0}, {0, 0, 1e-4}};
        for (std::size_t h : {1u, 2u}) {
            crowded.document.handles[h].motion = AffineMotion{};
            crowded.document.handles[h].force = GripForce{forces[h - 1]};
        }
        crowded.document.handles[0].motion = AffineMotion{};
        EmbeddedRunner runner([] {});
        const Body body{.name = "body", .surface = crowded.proxy->surface, .material = {1.0, 0.3}};
        runner.set_body(body, Method{.kind = kFem, .update = Update::direct}, crowded.proxy);
        test::wait_for([&] {
            runner.set_constraints(crowded.constraints());
            runner.poll();
            return runner.ready() && !runner.grip_motions().empty();
        });
        ASSERT_EQ(runner.gripped().size(), 1u);
        ASSERT_EQ(runner.grip_motions().size(), 1u);
        const std::size_t there = runner.gripped()[0], missing = 3 - there;
        const auto moved = [&](std::size_t h) {
            return std::get<AffineMotion>(runner.shown_constraints().motions[h]).translate;
        };
        EXPECT_GT(moved(there).normalized().dot(forces[there - 1].normalized()), 0.7);
        EXPECT_EQ(moved(missing), Eigen::Vector3d(0, 0, 0));
        std::vector<std::string> idle;
        for (const Finding& finding : runner.findings())
            if (finding.kind == FindingKind::idle_handle) idle.push_back(finding.object);
        EXPECT_THAT(idle, testing::ElementsAre(crowded.document.handles[missing].name));
    }
}

/// Bodies, none of which served to tune anything here: the coarse answer against the fine one of the same method.
TEST(Proxy, AnswersWithinATenthOfTheFineAnswer) {
    for (const char* name : {"sphere", "cylinder", "torus", "beam"}) {
        SCOPED_TRACE(name);
        const SurfaceMesh mesh = make_primitive(name, std::string(name) == "beam" ? 4 : 5, {});
        const double low = mesh.vertices.row(0).minCoeff(), high = mesh.vertices.row(0).maxCoeff();
        Document document;
        document.fixed = {{.select = slab(low - 1.0, low + 0.2 * (high - low))}};
        document.handles = {{.name = "end",
                             .select = slab(high - 0.15 * (high - low), high + 1.0),
                             .motion = AffineMotion{.translate = {0.1, 0.3, 0.2}}}};
        const Constraints shown = make_constraints(document, mesh, "s.json");
        Control control;
        const Body body{.name = name, .surface = std::make_shared<const SurfaceMesh>(mesh), .material = {1.0, 0.3}};
        Deformer fine(precompute(body, Method{.kind = kQuadraticFem, .update = Update::direct}, control));
        fine.constrain(shown.set, control);
        const Eigen::VectorXd exact = fine.displace(shown.values);
        CarriedConstraints carried(proxy_of(mesh, 130));
        carried.set(shown);
        const Eigen::VectorXd u = carried.displacement(solved(carried));
        EXPECT_LT((u - exact).norm(), 0.1 * exact.norm());
        const bool is_coarser = carried.proxy().surface->n_vertices() < mesh.n_vertices();
        EXPECT_EQ((u - exact).norm() > 1e-6 * exact.norm(), is_coarser);
    }
}

/// A bar some of whose triangles in the middle of a side are missing, and the whole one.
TEST(FilledSurface, AnswersWithTheVerticesThatAreShown) {
    const SurfaceMesh intact = make_primitive("beam", 6, {});
    SurfaceMesh open = intact;
    std::vector<int> kept;
    for (int t = 0; t < intact.n_triangles(); ++t) {
        const Eigen::Vector3d middle = intact.vertices(Eigen::all, intact.triangles.col(t)).rowwise().mean();
        const bool on_top = middle.z() > intact.vertices.row(2).maxCoeff() - 1e-9;
        if (!on_top || std::abs(middle.x() - 2.0) > 0.2 || std::abs(middle.y() - 0.5) > 0.2) kept.push_back(t);
    }
    ASSERT_LT(std::ssize(kept), intact.n_triangles());
    open.triangles = intact.triangles(Eigen::all, kept);
    const CheckedMesh checked = check_and_repair(open);
    ASSERT_FALSE(checked.report.usable());
    Control control;
    const auto proxy = make_proxy("body", std::make_shared<const SurfaceMesh>(checked.mesh), checked.report,
                                  {.use = ProxyUse::fill}, control);
    EXPECT_EQ(proxy->n_closed_holes, 1);

    CarriedConstraints carried(proxy);
    const Constraints shown = make_constraints(bar(AffineMotion{.translate = {0, 0, 0.5}}), checked.mesh, "s.json");
    carried.set(shown);
    EXPECT_EQ(carried.constraints().set.fixed.size(), shown.set.fixed.size());
    EXPECT_EQ(carried.constraints().set.handles.size(), shown.set.handles.size());
    const Eigen::VectorXd u = carried.displacement(solved(carried));
    Deformer whole(precompute({.name = "whole", .surface = std::make_shared<const SurfaceMesh>(intact), .material = {}},
                              Method{.kind = kQuadraticFem, .update = Update::direct}, control));
    const Constraints of_whole = make_constraints(bar(AffineMotion{.translate = {0, 0, 0.5}}), intact, "s.json");
    whole.constrain(of_whole.set, control);
    const Eigen::VectorXd expected = whole.displace(of_whole.values);
    ASSERT_EQ(u.size(), expected.size());
    std::set<int> used;
    for (const int v : open.triangles.reshaped()) used.insert(v);
    EXPECT_LT(std::ssize(used), open.n_vertices());
    double off = 0.0;
    for (const int v : used) off += (u.segment<3>(3 * v) - expected.segment<3>(3 * v)).squaredNorm();
    EXPECT_LT(std::sqrt(off), 0.01 * expected.norm());
    for (const int v : shown.set.fixed) EXPECT_EQ(u.segment<3>(3 * v).norm(), 0.0);
}

}  // namespace
}  // namespace elastolab

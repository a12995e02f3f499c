"""A block with two families of fibres in another finite-element code (dolfinx 0.5 with UFL, Debian's python3-dolfinx), on the mesh and with
the element that Bulbus has: trilinear displacements, a constant pressure, 2 x 2 x 2 Gauss points, exactly incompressible.

    python3 data/references/fibre_block.py > data/references/fibre_block.csv

4 x 3 x 3 hexahedra of a block 2 x 1 x 1 mm, inner nodes moved; W = c10 (I1 - 3) + k1/(2 k2) sum(exp(k2 <E>^2) - 1); the face x = 0 is held,
the face x = 2 carries a dead traction. Directions turn along x and are those at the middle of each hexahedron. UFL differentiates the
energy: neither stress nor tangent is written down here.
"""
import dolfinx
import numpy as np
import ufl
from dolfinx import fem, mesh
from dolfinx.fem import petsc as _  # noqa: F401
from dolfinx.nls.petsc import NewtonSolver
from mpi4py import MPI
from petsc4py import PETSc

c10, k1, k2, traction = .05, .08, 3., (.06, .02, .01)
steps = 10


def moved(x):
    """Inner nodes, by up to .06 mm."""
    bump = np.sin(np.pi * x[:, 0] / 2) * np.sin(np.pi * x[:, 1]) * np.sin(np.pi * x[:, 2])
    return x + np.outer(bump, [.06, -.05, .04])


def solve(kappa):
    block = mesh.create_box(MPI.COMM_SELF, [[0, 0, 0], [2, 1, 1]], [4, 3, 3], mesh.CellType.hexahedron)
    block.geometry.x[:] = moved(block.geometry.x)
    cell = block.ufl_cell()
    space = fem.FunctionSpace(block, ufl.MixedElement(ufl.VectorElement('Lagrange', cell, 1), ufl.FiniteElement('DG', cell, 0)))
    w = fem.Function(space)
    u, p = ufl.split(w)
    F = ufl.Identity(3) + ufl.grad(u)
    J = ufl.det(F)
    C = J ** (-2 / 3) * F.T * F
    W = c10 * (ufl.tr(C) - 3)
    constant = fem.FunctionSpace(block, ufl.VectorElement('DG', cell, 0))
    for sign in (1, -1):
        M = fem.Function(constant)
        M.interpolate(lambda x: np.array([np.cos(.6 + .3 * x[0]), sign * np.sin(.6 + .3 * x[0]), 0 * x[0]]))
        E = kappa * (ufl.tr(C) - 3) + (1 - 3 * kappa) * (ufl.dot(M, C * M) - 1)
        W += ufl.conditional(ufl.gt(E, 0), k1 / (2 * k2) * (ufl.exp(k2 * E ** 2) - 1), 0)
    dx = ufl.Measure('dx', block, metadata={'quadrature_degree': 3})
    facets = mesh.locate_entities_boundary(block, 2, lambda x: np.isclose(x[0], 2))
    ds = ufl.Measure('ds', block, subdomain_data=mesh.meshtags(block, 2, np.sort(facets), np.full(len(facets), 1, dtype=np.int32)),
                     metadata={'quadrature_degree': 3})
    load = fem.Constant(block, PETSc.ScalarType((0, 0, 0)))
    potential = W * dx + p * (J - 1) * dx - ufl.dot(load, u) * ds(1)
    residual = ufl.derivative(potential, w, ufl.TestFunction(space))
    held = mesh.locate_entities_boundary(block, 2, lambda x: np.isclose(x[0], 0))
    displacement, _ = space.sub(0).collapse()
    zero = fem.Function(displacement)
    dofs = fem.locate_dofs_topological((space.sub(0), displacement), 2, held)
    problem = dolfinx.fem.petsc.NonlinearProblem(residual, w, [fem.dirichletbc(zero, dofs, space.sub(0))])
    solver = NewtonSolver(MPI.COMM_SELF, problem)
    solver.rtol, solver.atol, solver.max_it = 1e-14, 1e-13, 30
    solver.error_on_nonconvergence = False
    linear = solver.krylov_solver
    linear.setType('preonly')
    linear.getPC().setType('lu')
    linear.getPC().setFactorSolverType('mumps')
    for i in range(1, steps + 1):
        load.value[:] = np.array(traction) * i / steps
        solver.solve(w)
    final = w.sub(0).collapse()
    nodes = displacement.tabulate_dof_coordinates()
    return {corner: final.x.array.reshape(-1, 3)[np.argmin(np.linalg.norm(nodes - corner, axis=1))]
            for corner in ((2, 0, 0), (2, 1, 0), (2, 0, 1), (2, 1, 1))}


if __name__ == '__main__':
    print('# made by fibre_block.py with dolfinx', dolfinx.__version__)
    print('kappa,X,Y,Z,ux,uy,uz')
    for kappa in (0, .15):
        for corner, u in solve(kappa).items():
            print(kappa, *corner, *(f'{v:.12g}' for v in u), sep=',')

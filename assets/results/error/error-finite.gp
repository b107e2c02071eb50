# Draws error-finite.svg and error-finite.png: gnuplot error-finite.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'error-finite.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Error of large deformations against the size of the elements'
set xlabel 'cells'
set ylabel 'relative error (rms)'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'error.csv' using ((strcol('part') eq 'finite' && strcol('problem') eq 'finite-bending' && strcol('nu') eq '0.3' && strcol('variant') eq 'nonlinear-fem' ? column('size') : NaN)):(column('error')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'finite-bending', \
  'error.csv' using ((strcol('part') eq 'finite' && strcol('problem') eq 'finite-bending' && strcol('nu') eq '0.3' && strcol('variant') eq 'nonlinear-fem of four nodes' ? column('size') : NaN)):(column('error')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 2 title 'finite-bending, four nodes', \
  'error.csv' using ((strcol('part') eq 'finite' && strcol('problem') eq 'finite-torsion' && strcol('nu') eq '0.3' && strcol('variant') eq 'nonlinear-fem' ? column('size') : NaN)):(column('error')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'finite-torsion', \
  'error.csv' using ((strcol('part') eq 'finite' && strcol('problem') eq 'finite-torsion' && strcol('nu') eq '0.3' && strcol('variant') eq 'nonlinear-fem of four nodes' ? column('size') : NaN)):(column('error')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 2 title 'finite-torsion, four nodes', \
  'error.csv' using ((strcol('part') eq 'finite' && strcol('problem') eq 'finite-swelling' && strcol('nu') eq '0.3' && strcol('variant') eq 'nonlinear-fem' ? column('size') : NaN)):(column('error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'finite-swelling', \
  'error.csv' using ((strcol('part') eq 'finite' && strcol('problem') eq 'finite-swelling' && strcol('nu') eq '0.3' && strcol('variant') eq 'nonlinear-fem of four nodes' ? column('size') : NaN)):(column('error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 2 title 'finite-swelling, four nodes'
unset output
reset
}

# Draws stability-nu-to-half.svg and stability-nu-to-half.png: gnuplot stability-nu-to-half.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'stability-nu-to-half.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Error in the trial: nu-to-half'
set xlabel '1/2 - nu (1/2 itself: 1e-10)'
set ylabel 'largest error / largest displacement'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
plot \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'fem' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#0072b2' lw 2 pt 7 ps 0.8 dt 1 title 'fem', \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'constant-bem' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#d55e00' lw 2 pt 5 ps 0.8 dt 1 title 'constant-bem', \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'galerkin-bem' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#cc79a7' lw 2 pt 13 ps 0.8 dt 1 title 'galerkin-bem', \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'quadratic-fem' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#e69f00' lw 2 pt 11 ps 0.8 dt 1 title 'quadratic-fem', \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'linear-bem' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'linear-bem', \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'linear-bem restricted' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#56b4e9' lw 2 pt 6 ps 0.8 dt 2 title 'linear-bem restricted', \
  'stability.csv' using ((strcol('group') eq 'nu-to-half' && strcol('variant') eq 'linear-bem continuous' ? (0.5 - column('level') + 1e-10) : NaN)):(column('error_max')) with linespoints lc rgb '#666666' lw 2 pt 4 ps 0.8 dt 2 title 'linear-bem continuous'
unset output
reset
}

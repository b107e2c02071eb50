# Draws stretch.svg and stretch.png: gnuplot stretch.gp
set encoding utf8
do for [kind in 'svg png'] {
if (kind eq 'svg') {
set terminal svg size 900,520 font 'sans,14' background 'white'
} else {
set terminal pngcairo size 1350,780 font 'sans,18'
}
set output 'stretch.'.kind
set datafile separator ','
set datafile missing NaN
set title 'Linear theory against the stretch of a bar'
set xlabel 'stretch [per cent]'
set ylabel 'error of linear theory'
set grid lc rgb '#dddddd' lt 1
set key outside right top Left reverse
set tics nomirror
set border 3
set logscale x
set format x '%g'
set logscale y
set format y '%g'
set arrow from graph 0, first 0.02 to graph 1, first 0.02 nohead dt 2 lc rgb '#888888'
plot \
  'large.csv' using ((strcol('part') eq 'theory' && strcol('motion') eq 'stretch' ? column('amount') : NaN)):(column('largest_error')) with linespoints lc rgb '#009e73' lw 2 pt 9 ps 0.8 dt 1 title 'bar stretched'
unset output
reset
}
